// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 17 cycles on gcn
// error: RMSE 0.00658, max 0.06751 on the search split
//        RMSE 0.00658, max 0.07564 on the validation split
//        scale: RMSE 0.00684, max 0.04792
//        bias: RMSE 0.00630, max 0.06751
// finite on every sample of both splits
// t0 = max(roughness - 0.41*n_dot_v, 0.04); bias = exp2(t0*(n_dot_v - t0*(15.73 - 11.8*t0)) - 0.091 - n_dot_v*(7.8*n_dot_v + 5.9)); t1 = n_dot_v*(roughness*t0 - 0.018); t2 = 0.8845 - 0.96*t1; scale = t2*(t2 + bias*(-25.4*t1 - 1.172)) + 0.1994
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = f32::max(roughness - 0.41*n_dot_v, 0.04);
    let t1 = t0*(n_dot_v - t0*(15.73 - 11.8*t0)) - 0.091;
    let bias = f32::exp2(t1 - n_dot_v*(7.8*n_dot_v + 5.9));
    let t2 = n_dot_v*(roughness*t0 - 0.018);
    let t3 = 0.8845 - 0.96*t2;
    let scale = t3*(t3 + bias*(-25.4*t2 - 1.172)) + 0.1994;
    (scale, bias)
}
