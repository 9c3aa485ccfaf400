// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 8 cycles on gcn
// error: RMSE 0.01833, max 0.09212 on the search split
//        RMSE 0.01834, max 0.12956 on the validation split
//        scale: RMSE 0.02037, max 0.09212
//        bias: RMSE 0.01602, max 0.07833
// finite on every sample of both splits
// t0 = saturate(saturate(roughness*(2.7*n_dot_v - 1.27) + 1.05) - 1.9*n_dot_v); bias = t0^2 + 0.009; scale = saturate(n_dot_v*(roughness*(0.57*n_dot_v - 1.8) + 0.69) + 0.879) - 0.891*bias
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = saturate(saturate(roughness*(2.7*n_dot_v - 1.27) + 1.05) - 1.9*n_dot_v);
    const float bias = t0*t0 + 0.009;
    const float t1 = saturate(n_dot_v*(roughness*(0.57*n_dot_v - 1.8) + 0.69) + 0.879);
    const float scale = t1 - 0.891*bias;
    return float2(scale, bias);
}
