// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 17 cycles on gcn
// error: RMSE 0.00757, max 0.08875 on the search split
//        RMSE 0.00765, max 0.09072 on the validation split
//        scale: RMSE 0.00943, max 0.04485
//        bias: RMSE 0.00507, max 0.08875
// finite on every sample of both splits
// t0 = -0.16*roughness - n_dot_v; t1 = 0.066 - 0.75*t0; t2 = max(roughness, t1); t3 = t1*(t2*(n_dot_v + 1) - 4.1) + 0.59; t4 = 0.664 - 0.32*t2; t5 = t4*(t3*t4 + (0.31 - 1.95*t2)) + 0.743; t6 = t5^2; scale = (((1.6 - 11*roughness)*t3 + 0.75)*(roughness + 0.27*t0) + 1)*(-0.0725 - t6) + 1.077; bias = t6 + 0.0013
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = -0.16*roughness - n_dot_v;
    let t1 = 0.066 - 0.75*t0;
    let t2 = max(roughness, t1);
    let t3 = t1*(t2*(n_dot_v + 1.0) - 4.1) + 0.59;
    let t4 = 0.664 - 0.32*t2;
    let t5 = t4*(t3*t4 + (0.31 - 1.95*t2)) + 0.743;
    let t6 = t5*t5;
    let t7 = ((1.6 - 11.0*roughness)*t3 + 0.75)*(roughness + 0.27*t0) + 1.0;
    let scale = t7*(-0.0725 - t6) + 1.077;
    let bias = t6 + 0.0013;
    return vec2<f32>(scale, bias);
}
