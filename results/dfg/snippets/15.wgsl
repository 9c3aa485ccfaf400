// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 14 cycles on gcn
// error: RMSE 0.00895, max 0.07124 on the search split
//        RMSE 0.00900, max 0.07698 on the validation split
//        scale: RMSE 0.01077, max 0.04811
//        bias: RMSE 0.00665, max 0.07124
// finite on every sample of both splits
// t0 = n_dot_v*(0.66 - 0.45*n_dot_v) - 0.84; t1 = roughness*t0 + 1.9; t2 = saturate(t1 + 0.98*t0); t3 = saturate(t2 - 1.5*n_dot_v); bias = (t3*(t1*t3 - t3) + 0.054)*(t3 - 0.14*n_dot_v) + 0.0087; scale = saturate(n_dot_v*(roughness*(t2 - 2.36 + 0.67*n_dot_v) + 0.348) + 0.942) - 1.006*bias
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = n_dot_v*(0.66 - 0.45*n_dot_v) - 0.84;
    let t1 = roughness*t0 + 1.9;
    let t2 = saturate(t1 + 0.98*t0);
    let t3 = saturate(t2 - 1.5*n_dot_v);
    let bias = (t3*(t1*t3 - t3) + 0.054)*(t3 - 0.14*n_dot_v) + 0.0087;
    let t4 = saturate(n_dot_v*(roughness*(t2 - 2.36 + 0.67*n_dot_v) + 0.348) + 0.942);
    let scale = t4 - 1.006*bias;
    return vec2<f32>(scale, bias);
}
