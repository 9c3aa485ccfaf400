// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 15 cycles on gcn
// error: RMSE 0.00839, max 0.07009 on the search split
//        RMSE 0.00846, max 0.08793 on the validation split
//        scale: RMSE 0.00969, max 0.05707
//        bias: RMSE 0.00685, max 0.07009
// finite on every sample of both splits
// t0 = n_dot_v*(2.03 - 0.9*n_dot_v) + (-0.54*roughness - 1.62); t1 = roughness*t0; t2 = t1 + 0.35; t3 = saturate(n_dot_v - 0.66*(t1 + 0.1) + (0.53*t2 + 0.39 - 0.34*n_dot_v)*max(roughness, saturate(1.236*t0 + 2.137))); bias = (t3 - 2.023)*t3 + 1.0267; scale = saturate(n_dot_v*t2 + 0.949) - 1.0126*bias
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = n_dot_v*(2.03 - 0.9*n_dot_v) + (-0.54*roughness - 1.62);
    let t1 = roughness*t0;
    let t2 = t1 + 0.35;
    let t3 = f32::max(roughness, f32::clamp(1.236*t0 + 2.137, 0.0, 1.0));
    let t4 = n_dot_v - 0.66*(t1 + 0.1) + (0.53*t2 + 0.39 - 0.34*n_dot_v)*t3;
    let t5 = f32::clamp(t4, 0.0, 1.0);
    let bias = (t5 - 2.023)*t5 + 1.0267;
    let scale = f32::clamp(n_dot_v*t2 + 0.949, 0.0, 1.0) - 1.0126*bias;
    (scale, bias)
}
