// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 17 cycles on gcn
// error: RMSE 0.00776, max 0.06818 on the search split
//        RMSE 0.00782, max 0.08640 on the validation split
//        scale: RMSE 0.00950, max 0.06818
//        bias: RMSE 0.00548, max 0.05514
// finite on every sample of both splits
// t0 = 0.4*n_dot_v - 1.63; t1 = roughness*t0 + 0.736; t2 = saturate(n_dot_v + roughness*(0.8*roughness + 0.5) + (0.99*t1 + 0.414 - 0.96*n_dot_v)*max(roughness, 2.82*t0 + 4.662)); bias = t2*(t2 - 2.13) + 1.1305; scale = bias*(3.274 - 4.2*saturate(n_dot_v + 1.2 - 0.8*roughness)) + (saturate(n_dot_v*t1 + 0.875) - 0.0722*roughness)
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = 0.4*n_dot_v - 1.63;
    let t1 = roughness*t0 + 0.736;
    let t2 = 0.8*roughness;
    let t3 = (0.99*t1 + 0.414 - 0.96*n_dot_v)*max(roughness, 2.82*t0 + 4.662);
    let t4 = saturate(n_dot_v + roughness*(t2 + 0.5) + t3);
    let bias = t4*(t4 - 2.13) + 1.1305;
    let t5 = saturate(n_dot_v*t1 + 0.875) - 0.0722*roughness;
    let scale = bias*(3.274 - 4.2*saturate(n_dot_v + 1.2 - t2)) + t5;
    return vec2<f32>(scale, bias);
}
