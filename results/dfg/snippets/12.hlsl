// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 11 cycles on gcn
// error: RMSE 0.01407, max 0.07747 on the search split
//        RMSE 0.01408, max 0.08938 on the validation split
//        scale: RMSE 0.01667, max 0.07747
//        bias: RMSE 0.01087, max 0.05824
// finite on every sample of both splits
// t0 = 0.8*n_dot_v - 0.03; t1 = roughness - 0.39*t0; t2 = -0.014 - (0.0267 - 0.03*max(n_dot_v, roughness))*(36.7 - 51*n_dot_v); bias = t2^2 + 0.005; t3 = t1*(t0*t1 + 0.09) - 1.004; scale = t3*(t3 + 1.06*bias)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = 0.8*n_dot_v - 0.03;
    const float t1 = roughness - 0.39*t0;
    const float t2 = -0.014 - (0.0267 - 0.03*max(n_dot_v, roughness))*(36.7 - 51.0*n_dot_v);
    const float bias = t2*t2 + 0.005;
    const float t3 = t1*(t0*t1 + 0.09) - 1.004;
    const float scale = t3*(t3 + 1.06*bias);
    return float2(scale, bias);
}
