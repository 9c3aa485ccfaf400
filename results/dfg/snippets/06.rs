// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 5 cycles on gcn
// error: RMSE 0.03136, max 0.15166 on the search split
//        RMSE 0.03134, max 0.17100 on the validation split
//        scale: RMSE 0.03341, max 0.15166
//        bias: RMSE 0.02916, max 0.14594
// finite on every sample of both splits
// t0 = 0.85 - 1.45*roughness; t1 = n_dot_v*t0 - 0.008; bias = saturate(t0 - 2.45*abs(t1)); scale = saturate(0.93*t1 + 0.796) - 0.77*bias
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = 0.85 - 1.45*roughness;
    let t1 = n_dot_v*t0 - 0.008;
    let bias = f32::clamp(t0 - 2.45*f32::abs(t1), 0.0, 1.0);
    let scale = f32::clamp(0.93*t1 + 0.796, 0.0, 1.0) - 0.77*bias;
    (scale, bias)
}
