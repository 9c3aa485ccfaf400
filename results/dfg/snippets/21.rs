// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 20 cycles on gcn
// error: RMSE 0.00571, max 0.04422 on the search split
//        RMSE 0.00575, max 0.06361 on the validation split
//        scale: RMSE 0.00680, max 0.04131
//        bias: RMSE 0.00435, max 0.04422
// finite on every sample of both splits
// t0 = roughness - 0.25*n_dot_v; t1 = max(t0, 0.03); t2 = max(n_dot_v, roughness) - 0.69*n_dot_v; bias = exp2(t2*(-0.885 - t1*(12.9 - 9.9*t2)) - 0.0527 - n_dot_v*(6.42*n_dot_v + 6.1)); t3 = n_dot_v*(0.02195 - t0*t1); t4 = 1.077*t3 + 0.8722; scale = t4*(min(t4, 0.8558) + bias*(29.37*t3 - 1.2005)) + 0.23349
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = roughness - 0.25*n_dot_v;
    let t1 = f32::max(t0, 0.03);
    let t2 = f32::max(n_dot_v, roughness) - 0.69*n_dot_v;
    let t3 = t2*(-0.885 - t1*(12.9 - 9.9*t2)) - 0.0527 - n_dot_v*(6.42*n_dot_v + 6.1);
    let bias = f32::exp2(t3);
    let t4 = n_dot_v*(0.02195 - t0*t1);
    let t5 = 1.077*t4 + 0.8722;
    let scale = t5*(f32::min(t5, 0.8558) + bias*(29.37*t4 - 1.2005)) + 0.23349;
    (scale, bias)
}
