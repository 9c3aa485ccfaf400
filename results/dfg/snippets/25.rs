// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 29 cycles on gcn
// error: RMSE 0.00492, max 0.08449 on the search split
//        RMSE 0.00493, max 0.08620 on the validation split
//        scale: RMSE 0.00555, max 0.03029
//        bias: RMSE 0.00420, max 0.08449
// finite on every sample of both splits
// t0 = n_dot_v + 0.05; t1 = 0.757*(roughness + 0.51*n_dot_v); bias = exp2((-6.3*n_dot_v - 5.7)*max(t0, t1) - t1 + 0.258); scale = min(0.7569 - (exp2(max(roughness - 1.6*n_dot_v, 0.12)*(roughness - 3.72) - t0*(12.38 - n_dot_v)) - 0.0611)*((roughness - 0.74)*(-3.16*roughness - 4.94 - 14.7*min(n_dot_v, t1)) - 1.831), 0.9942)
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = n_dot_v + 0.05;
    let t1 = 0.757*(roughness + 0.51*n_dot_v);
    let bias = f32::exp2((-6.3*n_dot_v - 5.7)*f32::max(t0, t1) - t1 + 0.258);
    let t2 = f32::max(roughness - 1.6*n_dot_v, 0.12)*(roughness - 3.72);
    let t3 = (roughness - 0.74)*(-3.16*roughness - 4.94 - 14.7*f32::min(n_dot_v, t1));
    let t4 = 0.7569 - (f32::exp2(t2 - t0*(12.38 - n_dot_v)) - 0.0611)*(t3 - 1.831);
    let scale = f32::min(t4, 0.9942);
    (scale, bias)
}
