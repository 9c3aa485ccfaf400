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
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = n_dot_v*(1.88 - 0.8*n_dot_v) + (-0.5*roughness - 1.63);
    const float t1 = roughness*t0;
    const float t2 = t1 + 0.377;
    const float t3 = max(roughness, saturate(1.22*t0 + 2.118));
    const float t4 = n_dot_v - 0.63*(t1 + 0.13) + (0.53*t2 + 0.445 - 0.43*n_dot_v)*t3;
    const float t5 = saturate(t4);
    const float bias = (t5 - 2.003)*t5 + 1.0053;
    const float scale = saturate(n_dot_v*t2 + 0.95) - 0.00484 - 1.007*bias;
    return float2(scale, bias);
}
