// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 13 cycles on gcn
// error: RMSE 0.01139, max 0.10128 on the search split
//        RMSE 0.01141, max 0.09937 on the validation split
//        scale: RMSE 0.01300, max 0.05592
//        bias: RMSE 0.00952, max 0.10128
// finite on every sample of both splits
// t0 = 0.87*n_dot_v + 0.07; t1 = max(roughness, t0); t2 = n_dot_v*(1.57*t1 - 3.32); t3 = (0.322 - 0.171*t1)*(t2 - 5.64*t1) + 1.103; bias = t3^2; t4 = (roughness*t2 - 0.021)*(t0 - 2.2*roughness) + 0.999; scale = t4*(-0.30584 - bias*t4) + 1.28153
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = 0.87*n_dot_v + 0.07;
    let t1 = max(roughness, t0);
    let t2 = n_dot_v*(1.57*t1 - 3.32);
    let t3 = (0.322 - 0.171*t1)*(t2 - 5.64*t1) + 1.103;
    let bias = t3*t3;
    let t4 = (roughness*t2 - 0.021)*(t0 - 2.2*roughness) + 0.999;
    let scale = t4*(-0.30584 - bias*t4) + 1.28153;
    return vec2<f32>(scale, bias);
}
