// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 2 cycles on gcn
// error: RMSE 0.11134, max 0.89150 on the search split
//        RMSE 0.11108, max 0.92501 on the validation split
//        scale: RMSE 0.08431, max 0.30066
//        bias: RMSE 0.13298, max 0.89150
// finite on every sample of both splits
// scale = saturate(roughness + n_dot_v*(2.5 - 3.5*roughness)); bias = 0.07
float2 dfg(float n_dot_v, float roughness) {
    const float scale = saturate(roughness + n_dot_v*(2.5 - 3.5*roughness));
    const float bias = 0.07;
    return float2(scale, bias);
}
