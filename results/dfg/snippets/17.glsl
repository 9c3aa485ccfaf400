// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 16 cycles on gcn
// error: RMSE 0.00826, max 0.08841 on the search split
//        RMSE 0.00831, max 0.10303 on the validation split
//        scale: RMSE 0.00970, max 0.05179
//        bias: RMSE 0.00651, max 0.08841
// finite on every sample of both splits
// t0 = 1.3*roughness - 0.11; t1 = max(n_dot_v, t0); t2 = n_dot_v*(1.7*t1 - 2.9); t3 = (0.41 - 0.166*t1)*(t2 + (0.32*t0 - roughness) - 2.6*t1) + 0.992; bias = t3^2; scale = (t0*(n_dot_v + (t2 - 0.12)*(n_dot_v - 0.8*roughness)) + 0.18)*(t3 + (-7.02*bias - 0.72)) + 1.1215
vec2 dfg(float n_dot_v, float roughness) {
    float t0 = 1.3*roughness - 0.11;
    float t1 = max(n_dot_v, t0);
    float t2 = n_dot_v*(1.7*t1 - 2.9);
    float t3 = (0.41 - 0.166*t1)*(t2 + (0.32*t0 - roughness) - 2.6*t1) + 0.992;
    float bias = t3*t3;
    float t4 = t0*(n_dot_v + (t2 - 0.12)*(n_dot_v - 0.8*roughness)) + 0.18;
    float scale = t4*(t3 + (-7.02*bias - 0.72)) + 1.1215;
    return vec2(scale, bias);
}
