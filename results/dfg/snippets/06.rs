// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 5 cycles on gcn
// error: RMSE 0.05739, max 0.39275 on the search split
//        RMSE 0.05725, max 0.39895 on the validation split
//        scale: RMSE 0.07291, max 0.39275
//        bias: RMSE 0.03567, max 0.19317
// finite on every sample of both splits
// t0 = 0.8 - 1.7*(n_dot_v + 0.55*roughness); bias = max(t0, 0.018); scale = t0*(0.8*roughness - 0.493) + 0.776
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = 0.8 - 1.7*(n_dot_v + 0.55*roughness);
    let bias = f32::max(t0, 0.018);
    let scale = t0*(0.8*roughness - 0.493) + 0.776;
    (scale, bias)
}
