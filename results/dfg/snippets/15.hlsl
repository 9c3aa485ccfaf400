// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 14 cycles on gcn
// error: RMSE 0.00956, max 0.09455 on the search split
//        RMSE 0.00958, max 0.09512 on the validation split
//        scale: RMSE 0.01043, max 0.04748
//        bias: RMSE 0.00860, max 0.09455
// finite on every sample of both splits
// t0 = 1.2*roughness - 0.105; t1 = max(n_dot_v, t0); t2 = n_dot_v*(1.6*t1 - 3.4); t3 = (0.346 - 0.163*t1)*(t2 - 0.7*roughness - 3.34*t1) + 0.9817; bias = t3^2; scale = 1.1345 - (t0*(n_dot_v + t2*(n_dot_v - 1.4*roughness)) + 0.346)*(3.05*bias + 0.3784)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = 1.2*roughness - 0.105;
    const float t1 = max(n_dot_v, t0);
    const float t2 = n_dot_v*(1.6*t1 - 3.4);
    const float t3 = (0.346 - 0.163*t1)*(t2 - 0.7*roughness - 3.34*t1) + 0.9817;
    const float bias = t3*t3;
    const float t4 = t0*(n_dot_v + t2*(n_dot_v - 1.4*roughness)) + 0.346;
    const float scale = 1.1345 - t4*(3.05*bias + 0.3784);
    return float2(scale, bias);
}
