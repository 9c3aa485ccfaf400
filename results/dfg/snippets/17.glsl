// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 16 cycles on gcn
// error: RMSE 0.00830, max 0.07676 on the search split
//        RMSE 0.00837, max 0.08948 on the validation split
//        scale: RMSE 0.00960, max 0.05433
//        bias: RMSE 0.00675, max 0.07676
// finite on every sample of both splits
// t0 = n_dot_v*(1.88 - 0.8*n_dot_v) + (-0.5*roughness - 1.63); t1 = roughness*t0; t2 = t1 + 0.377; t3 = saturate(n_dot_v - 0.63*(t1 + 0.13) + (0.53*t2 + 0.445 - 0.43*n_dot_v)*max(roughness, saturate(1.22*t0 + 2.118))); bias = (t3 - 2.003)*t3 + 1.0053; scale = saturate(n_dot_v*t2 + 0.95) - 0.00484 - 1.007*bias
vec2 dfg(float n_dot_v, float roughness) {
    float t0 = n_dot_v*(1.88 - 0.8*n_dot_v) + (-0.5*roughness - 1.63);
    float t1 = roughness*t0;
    float t2 = t1 + 0.377;
    float t3 = max(roughness, clamp(1.22*t0 + 2.118, 0.0, 1.0));
    float t4 = n_dot_v - 0.63*(t1 + 0.13) + (0.53*t2 + 0.445 - 0.43*n_dot_v)*t3;
    float t5 = clamp(t4, 0.0, 1.0);
    float bias = (t5 - 2.003)*t5 + 1.0053;
    float scale = clamp(n_dot_v*t2 + 0.95, 0.0, 1.0) - 0.00484 - 1.007*bias;
    return vec2(scale, bias);
}
