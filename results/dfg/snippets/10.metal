// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 9 cycles on gcn
// error: RMSE 0.01487, max 0.08427 on the search split
//        RMSE 0.01488, max 0.09652 on the validation split
//        scale: RMSE 0.01744, max 0.08427
//        bias: RMSE 0.01176, max 0.05870
// finite on every sample of both splits
// t0 = (1.54*n_dot_v - 1.18)*max(n_dot_v, roughness) + 1 - 1.3*n_dot_v; bias = t0^2 + 0.008; scale = saturate(n_dot_v*(roughness*(0.63*n_dot_v - 1.88) + 0.7) + 0.89) - 0.95*abs(bias)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = (1.54*n_dot_v - 1.18)*max(n_dot_v, roughness) + 1.0 - 1.3*n_dot_v;
    const float bias = t0*t0 + 0.008;
    const float t1 = saturate(n_dot_v*(roughness*(0.63*n_dot_v - 1.88) + 0.7) + 0.89);
    const float scale = t1 - 0.95*abs(bias);
    return float2(scale, bias);
}
