// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 4 cycles on gcn
// error: RMSE 0.04389, max 0.19242 on the search split
//        RMSE 0.04383, max 0.20667 on the validation split
//        scale: RMSE 0.04169, max 0.18180
//        bias: RMSE 0.04599, max 0.19242
// finite on every sample of both splits
// t0 = 0.84 - 1.3*roughness; bias = saturate(t0 - 1.6*n_dot_v); scale = saturate(n_dot_v*t0 + 0.74) - 0.68*bias
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = 0.84 - 1.3*roughness;
    let bias = saturate(t0 - 1.6*n_dot_v);
    let scale = saturate(n_dot_v*t0 + 0.74) - 0.68*bias;
    return vec2<f32>(scale, bias);
}
