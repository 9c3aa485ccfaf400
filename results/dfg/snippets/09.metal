// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 8 cycles on gcn
// error: RMSE 0.02463, max 0.14487 on the search split
//        RMSE 0.02464, max 0.17321 on the validation split
//        scale: RMSE 0.03049, max 0.14487
//        bias: RMSE 0.01685, max 0.08101
// finite on every sample of both splits
// t0 = 1.1*n_dot_v - 1; t1 = t0*(t0 - roughness*t0) + 0.001; bias = t1^2 + 0.007; scale = min(0.773 - (1.35*roughness - 0.81)*(n_dot_v + t0*t1), 0.9863)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = 1.1*n_dot_v - 1.0;
    const float t1 = t0*(t0 - roughness*t0) + 0.001;
    const float bias = t1*t1 + 0.007;
    const float scale = min(0.773 - (1.35*roughness - 0.81)*(n_dot_v + t0*t1), 0.9863);
    return float2(scale, bias);
}
