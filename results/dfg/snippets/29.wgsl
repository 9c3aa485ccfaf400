// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 34 cycles on gcn
// error: RMSE 0.00496, max 0.06400 on the search split
//        RMSE 0.00501, max 0.08256 on the validation split
//        scale: RMSE 0.00589, max 0.04833
//        bias: RMSE 0.00380, max 0.06400
// finite on every sample of both splits
// t0 = max(0.76*roughness, 0.6*n_dot_v); t1 = t0 - 0.073; t2 = exp2(t1 + (-4*max(n_dot_v, t1) - 7*n_dot_v)); scale = min(0.7571 - 6.845*((t2 - 0.161)*((roughness - 0.75)*(t0 + (-0.877*roughness - 0.343 - 0.8*n_dot_v)) - 0.1144)), 0.995); bias = t2*log2(exp2(t0*(-15.7*n_dot_v - 5.93) + 9.01*n_dot_v) + 1.0836)
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = max(0.76*roughness, 0.6*n_dot_v);
    let t1 = t0 - 0.073;
    let t2 = exp2(t1 + (-4.0*max(n_dot_v, t1) - 7.0*n_dot_v));
    let t3 = (roughness - 0.75)*(t0 + (-0.877*roughness - 0.343 - 0.8*n_dot_v));
    let scale = min(0.7571 - 6.845*((t2 - 0.161)*(t3 - 0.1144)), 0.995);
    let bias = t2*log2(exp2(t0*(-15.7*n_dot_v - 5.93) + 9.01*n_dot_v) + 1.0836);
    return vec2<f32>(scale, bias);
}
