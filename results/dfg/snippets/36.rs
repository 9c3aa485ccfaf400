// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 35 cycles on gcn
// error: RMSE 0.00295, max 0.03422 on the search split
//        RMSE 0.00307, max 0.07221 on the validation split
//        scale: RMSE 0.00328, max 0.03185
//        bias: RMSE 0.00257, max 0.03422
// finite on every sample of both splits
// t0 = saturate(1.03 - 0.7*roughness + 0.52*n_dot_v) - 1.22*n_dot_v; t1 = 26*roughness; t2 = n_dot_v + 8*roughness; t3 = t2 + 0.7; t4 = roughness*(0.4893*t3 - 2.778) + 0.2833 - 0.369*n_dot_v; t5 = t4 - min(roughness, saturate(0.93*roughness + 0.187*n_dot_v))*(3.88*roughness - 2.16); bias = t5^2*(t0*(t0*(t1 - 1.16*(roughness*t1 - 8)) + 2.65) + 0.27); t6 = (9.4 - 100*((roughness - 0.438*n_dot_v)*(n_dot_v*roughness + 0.035)))*(-0.00528*t0 - 0.00088 - 0.00361*n_dot_v); t7 = t6 + 0.04893; scale = t2*(t7*(t6 - 0.56766)) + 1.00027 + bias*(1.031*t4 - 1.7358 - 58.9*(t7 - 0.006512*t3 + 0.00655*bias))
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = f32::clamp(1.03 - 0.7*roughness + 0.52*n_dot_v, 0.0, 1.0) - 1.22*n_dot_v;
    let t1 = 26.0*roughness;
    let t2 = n_dot_v + 8.0*roughness;
    let t3 = t2 + 0.7;
    let t4 = roughness*(0.4893*t3 - 2.778) + 0.2833 - 0.369*n_dot_v;
    let t5 = f32::clamp(0.93*roughness + 0.187*n_dot_v, 0.0, 1.0);
    let t6 = t4 - f32::min(roughness, t5)*(3.88*roughness - 2.16);
    let bias = t6*t6*(t0*(t0*(t1 - 1.16*(roughness*t1 - 8.0)) + 2.65) + 0.27);
    let t7 = 9.4 - 100.0*((roughness - 0.438*n_dot_v)*(n_dot_v*roughness + 0.035));
    let t8 = t7*(-0.00528*t0 - 0.00088 - 0.00361*n_dot_v);
    let t9 = t8 + 0.04893;
    let t10 = bias*(1.031*t4 - 1.7358 - 58.9*(t9 - 0.006512*t3 + 0.00655*bias));
    let scale = t2*(t9*(t8 - 0.56766)) + 1.00027 + t10;
    (scale, bias)
}
