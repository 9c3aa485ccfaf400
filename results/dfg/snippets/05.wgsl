// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 4 cycles on gcn
// error: RMSE 0.08858, max 0.60598 on the search split
//        RMSE 0.08831, max 0.63558 on the validation split
//        scale: RMSE 0.09693, max 0.60598
//        bias: RMSE 0.07937, max 0.51760
// finite on every sample of both splits
// scale = n_dot_v*(0.57 - roughness^2) + 0.64; bias = 0.97 - 0.8*scale - 0.6*roughness
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let scale = n_dot_v*(0.57 - roughness*roughness) + 0.64;
    let bias = 0.97 - 0.8*scale - 0.6*roughness;
    return vec2<f32>(scale, bias);
}
