// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 22 cycles on gcn
// error: RMSE 0.00565, max 0.05073 on the search split
//        RMSE 0.00569, max 0.06655 on the validation split
//        scale: RMSE 0.00658, max 0.04118
//        bias: RMSE 0.00452, max 0.05073
// finite on every sample of both splits
// t0 = roughness - 0.32*n_dot_v; bias = exp2(t0^2*(8.5*t0 - 11.1) - (max(0.9*n_dot_v + 0.07, 1.6*(roughness - 0.8*n_dot_v)) + n_dot_v*(6.6*n_dot_v + 5.44))); t1 = n_dot_v*(roughness*max(roughness - 0.4*n_dot_v, 0.057) - 0.021); t2 = 0.889 - 0.94*t1; scale = t2*(t2 + bias*(-22.3*t1 - 1.177)) + 0.1912
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = roughness - 0.32*n_dot_v;
    const float t1 = max(0.9*n_dot_v + 0.07, 1.6*(roughness - 0.8*n_dot_v));
    const float bias = exp2(t0*t0*(8.5*t0 - 11.1) - (t1 + n_dot_v*(6.6*n_dot_v + 5.44)));
    const float t2 = n_dot_v*(roughness*max(roughness - 0.4*n_dot_v, 0.057) - 0.021);
    const float t3 = 0.889 - 0.94*t2;
    const float scale = t3*(t3 + bias*(-22.3*t2 - 1.177)) + 0.1912;
    return float2(scale, bias);
}
