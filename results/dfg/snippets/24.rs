// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 28 cycles on gcn
// error: RMSE 0.00498, max 0.08475 on the search split
//        RMSE 0.00500, max 0.08656 on the validation split
//        scale: RMSE 0.00567, max 0.03522
//        bias: RMSE 0.00418, max 0.08475
// finite on every sample of both splits
// t0 = 0.755*(roughness + 0.51*n_dot_v); bias = exp2((-6.3*n_dot_v - 5.73)*max(n_dot_v + 0.05, t0) - t0 + 0.26); scale = min(0.7568 - (exp2(max(n_dot_v, 0.7*roughness - 0.0865)*(1.56*roughness - 5.444) - 7*n_dot_v) - 0.1245)*((roughness - 0.7494)*(-1.853*roughness - 2.463 - 7*min(n_dot_v, t0)) - 0.983), 0.9944)
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = 0.755*(roughness + 0.51*n_dot_v);
    let t1 = (-6.3*n_dot_v - 5.73)*f32::max(n_dot_v + 0.05, t0) - t0 + 0.26;
    let bias = f32::exp2(t1);
    let t2 = f32::max(n_dot_v, 0.7*roughness - 0.0865)*(1.56*roughness - 5.444);
    let t3 = -1.853*roughness - 2.463 - 7.0*f32::min(n_dot_v, t0);
    let t4 = (f32::exp2(t2 - 7.0*n_dot_v) - 0.1245)*((roughness - 0.7494)*t3 - 0.983);
    let scale = f32::min(0.7568 - t4, 0.9944);
    (scale, bias)
}
