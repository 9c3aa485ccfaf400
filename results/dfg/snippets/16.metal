// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 15 cycles on gcn
// error: RMSE 0.00873, max 0.07456 on the search split
//        RMSE 0.00876, max 0.07654 on the validation split
//        scale: RMSE 0.01021, max 0.04664
//        bias: RMSE 0.00694, max 0.07456
// finite on every sample of both splits
// t0 = n_dot_v*(n_dot_v*(0.1*(n_dot_v*roughness) - 0.7) + 0.74) - 0.86; t1 = roughness*t0 + 1.89; t2 = saturate(t1 + 0.943*t0); t3 = saturate(t2 - 1.57*n_dot_v); bias = t3*(t3*(t1*t3 - t3) + 0.0725) + 0.0041; scale = saturate(n_dot_v*(roughness*(0.964*n_dot_v + (t2 - 2.453)) + 0.322) + 0.949) - 1.011*abs(bias)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = n_dot_v*(n_dot_v*(0.1*(n_dot_v*roughness) - 0.7) + 0.74) - 0.86;
    const float t1 = roughness*t0 + 1.89;
    const float t2 = saturate(t1 + 0.943*t0);
    const float t3 = saturate(t2 - 1.57*n_dot_v);
    const float bias = t3*(t3*(t1*t3 - t3) + 0.0725) + 0.0041;
    const float t4 = n_dot_v*(roughness*(0.964*n_dot_v + (t2 - 2.453)) + 0.322) + 0.949;
    const float scale = saturate(t4) - 1.011*abs(bias);
    return float2(scale, bias);
}
