// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 30 cycles on gcn
// error: RMSE 0.00497, max 0.06022 on the search split
//        RMSE 0.00502, max 0.07938 on the validation split
//        scale: RMSE 0.00589, max 0.04307
//        bias: RMSE 0.00385, max 0.06022
// finite on every sample of both splits
// t0 = max(0.8*roughness, 0.65*n_dot_v); t1 = t0 - 0.08; t2 = exp2(t1 + (-3.94*max(n_dot_v, t1) - 7.6*n_dot_v)); scale = min(0.75655 - 6.8107*((t2 - 0.1478)*((roughness - 0.738)*(t0 + (-0.92*roughness - 0.339 - 0.92*n_dot_v)) - 0.1101)), 0.9946); bias = t2*(exp2(t0*(-10.144*n_dot_v - 4.1417) - (0.01005 - 6.9528*n_dot_v)) + 0.06953795)
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = max(0.8*roughness, 0.65*n_dot_v);
    let t1 = t0 - 0.08;
    let t2 = exp2(t1 + (-3.94*max(n_dot_v, t1) - 7.6*n_dot_v));
    let t3 = (roughness - 0.738)*(t0 + (-0.92*roughness - 0.339 - 0.92*n_dot_v));
    let scale = min(0.75655 - 6.8107*((t2 - 0.1478)*(t3 - 0.1101)), 0.9946);
    let t4 = exp2(t0*(-10.144*n_dot_v - 4.1417) - (0.01005 - 6.9528*n_dot_v));
    let bias = t2*(t4 + 0.06953795);
    return vec2<f32>(scale, bias);
}
