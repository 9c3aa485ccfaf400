// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 20 cycles on gcn
// error: RMSE 0.00641, max 0.05308 on the search split
//        RMSE 0.00647, max 0.05988 on the validation split
//        scale: RMSE 0.00758, max 0.04095
//        bias: RMSE 0.00497, max 0.05308
// finite on every sample of both splits
// t0 = max(n_dot_v, roughness - 0.05); bias = exp2(t0*(roughness*(6*t0 - 7.6) - 2.82) - (n_dot_v*(6.1*n_dot_v + 3.1) + 0.09)); t1 = roughness + (0.088 - 0.27*n_dot_v); t2 = n_dot_v*(t1^2 - 0.056); t3 = 0.9909 - 0.7285*t2; scale = t3*(min(t3, 0.9799) + bias*(-15.6*t2 - 1.0504))
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = max(n_dot_v, roughness - 0.05);
    const float t1 = t0*(roughness*(6.0*t0 - 7.6) - 2.82);
    const float bias = exp2(t1 - (n_dot_v*(6.1*n_dot_v + 3.1) + 0.09));
    const float t2 = roughness + (0.088 - 0.27*n_dot_v);
    const float t3 = n_dot_v*(t2*t2 - 0.056);
    const float t4 = 0.9909 - 0.7285*t3;
    const float scale = t4*(min(t4, 0.9799) + bias*(-15.6*t3 - 1.0504));
    return float2(scale, bias);
}
