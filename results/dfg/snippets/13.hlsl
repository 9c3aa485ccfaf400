// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 12 cycles on gcn
// error: RMSE 0.01316, max 0.07143 on the search split
//        RMSE 0.01316, max 0.07187 on the validation split
//        scale: RMSE 0.01497, max 0.07143
//        bias: RMSE 0.01107, max 0.06061
// finite on every sample of both splits
// t0 = 0.65*n_dot_v + 0.013; t1 = roughness - 0.43*t0; t2 = (0.027 - 0.03*max(n_dot_v, roughness))*(36 - 51*n_dot_v) + 0.02; t3 = t2^2; t4 = t1*(t0*t1 + min(t0, 0.076)) - 1.08; scale = t4*(t3 + t4) - 0.164; bias = t3 + 0.004
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = 0.65*n_dot_v + 0.013;
    const float t1 = roughness - 0.43*t0;
    const float t2 = (0.027 - 0.03*max(n_dot_v, roughness))*(36.0 - 51.0*n_dot_v) + 0.02;
    const float t3 = t2*t2;
    const float t4 = t1*(t0*t1 + min(t0, 0.076)) - 1.08;
    const float scale = t4*(t3 + t4) - 0.164;
    const float bias = t3 + 0.004;
    return float2(scale, bias);
}
