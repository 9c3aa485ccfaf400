// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 9 cycles on gcn
// error: RMSE 0.02115, max 0.14958 on the search split
//        RMSE 0.02112, max 0.17578 on the validation split
//        scale: RMSE 0.02713, max 0.14958
//        bias: RMSE 0.01259, max 0.06797
// finite on every sample of both splits
// t0 = 0.83*n_dot_v - 0.91; t1 = t0*(t0 + 1.1*max(n_dot_v, roughness)) + 0.165; bias = t1^2 + 0.005; scale = min((0.853 - 1.4*roughness)*(n_dot_v + t0*t1) + 0.7752, 0.983)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = 0.83*n_dot_v - 0.91;
    const float t1 = t0*(t0 + 1.1*max(n_dot_v, roughness)) + 0.165;
    const float bias = t1*t1 + 0.005;
    const float scale = min((0.853 - 1.4*roughness)*(n_dot_v + t0*t1) + 0.7752, 0.983);
    return float2(scale, bias);
}
