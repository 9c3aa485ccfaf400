// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 3 cycles on gcn
// error: RMSE 0.10156, max 0.74384 on the search split
//        RMSE 0.10121, max 0.77531 on the validation split
//        scale: RMSE 0.09461, max 0.64543
//        bias: RMSE 0.10805, max 0.74384
// finite on every sample of both splits
// scale = n_dot_v*(0.5 - roughness^2) + 0.68; bias = 0.22 - 0.3*n_dot_v
float2 dfg(float n_dot_v, float roughness) {
    const float scale = n_dot_v*(0.5 - roughness*roughness) + 0.68;
    const float bias = 0.22 - 0.3*n_dot_v;
    return float2(scale, bias);
}
