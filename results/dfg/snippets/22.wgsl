// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 21 cycles on gcn
// error: RMSE 0.00586, max 0.06058 on the search split
//        RMSE 0.00593, max 0.08244 on the validation split
//        scale: RMSE 0.00705, max 0.03405
//        bias: RMSE 0.00437, max 0.06058
// finite on every sample of both splits
// t0 = n_dot_v + 1.1; t1 = (n_dot_v - 0.344*roughness)*(2.01 - 0.6*t0) - 1.57; t2 = roughness*t1; t3 = t2 + 0.465; t4 = saturate(1.075*n_dot_v - 0.683*(t2 + 0.114) + (0.506*t3 + 0.6727 - 0.4*t0)*max(roughness, 2.465*t1 + 3.945)); bias = t4*(t4 - 1.9564) + 0.95809; scale = bias*(2.0765 - 3.02486*(saturate(t0 - 0.58*roughness) + 0.2097*roughness)) + (saturate(n_dot_v*t3 + 0.9555) - 0.04575*roughness)
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = n_dot_v + 1.1;
    let t1 = (n_dot_v - 0.344*roughness)*(2.01 - 0.6*t0) - 1.57;
    let t2 = roughness*t1;
    let t3 = t2 + 0.465;
    let t4 = (0.506*t3 + 0.6727 - 0.4*t0)*max(roughness, 2.465*t1 + 3.945);
    let t5 = saturate(1.075*n_dot_v - 0.683*(t2 + 0.114) + t4);
    let bias = t5*(t5 - 1.9564) + 0.95809;
    let t6 = 2.0765 - 3.02486*(saturate(t0 - 0.58*roughness) + 0.2097*roughness);
    let scale = bias*t6 + (saturate(n_dot_v*t3 + 0.9555) - 0.04575*roughness);
    return vec2<f32>(scale, bias);
}
