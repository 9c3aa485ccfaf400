// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 7 cycles on gcn
// error: RMSE 0.03415, max 0.15189 on the search split
//        RMSE 0.03412, max 0.15397 on the validation split
//        scale: RMSE 0.03851, max 0.14672
//        bias: RMSE 0.02915, max 0.15189
// finite on every sample of both splits
// bias = max(0.85 - 1.16*(roughness - n_dot_v*(2.3*roughness - 1.9)), 0.015); scale = (0.35 - roughness^2)*(n_dot_v - 2.2*bias) + 0.785
float2 dfg(float n_dot_v, float roughness) {
    const float bias = max(0.85 - 1.16*(roughness - n_dot_v*(2.3*roughness - 1.9)), 0.015);
    const float scale = (0.35 - roughness*roughness)*(n_dot_v - 2.2*bias) + 0.785;
    return float2(scale, bias);
}
