// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 30 cycles on gcn
// error: RMSE 0.00400, max 0.06713 on the search split
//        RMSE 0.00405, max 0.08686 on the validation split
//        scale: RMSE 0.00430, max 0.03157
//        bias: RMSE 0.00367, max 0.06713
// finite on every sample of both splits
// t0 = saturate(n_dot_v*(1.34 - 2.1*roughness) + 1.035 - 0.32*roughness) - 0.1*n_dot_v; t1 = 0.08 - n_dot_v*roughness; t2 = 1.24*n_dot_v - 1.88; t3 = roughness*t2 + 0.1833; t4 = t3 + n_dot_v*saturate(n_dot_v*(0.636*n_dot_v - 1.8517) + 1.30865); t5 = 0.6486*t2 + 1.27815; t6 = (0.3386*t4 + 1.06247 - 1.554*n_dot_v)*max(roughness, t5) + (n_dot_v - 0.2081*t3 + 0.4488*t5); t7 = (t6 - 2.07367)*(t6 + 0.02464*n_dot_v) + 1.09734; scale = saturate((4.50282 - 5.5*(t0 + 0.113*roughness))*(t7 + 0.06435*t1) + (saturate(n_dot_v*t4 + 0.9941) + roughness*(1.6*saturate(0.137*n_dot_v + (roughness*t1 - 0.03)) - 0.122))); bias = t0*t7
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = n_dot_v*(1.34 - 2.1*roughness) + 1.035 - 0.32*roughness;
    let t1 = f32::clamp(t0, 0.0, 1.0) - 0.1*n_dot_v;
    let t2 = 0.08 - n_dot_v*roughness;
    let t3 = 1.24*n_dot_v - 1.88;
    let t4 = roughness*t3 + 0.1833;
    let t5 = n_dot_v*f32::clamp(n_dot_v*(0.636*n_dot_v - 1.8517) + 1.30865, 0.0, 1.0);
    let t6 = t4 + t5;
    let t7 = 0.6486*t3 + 1.27815;
    let t8 = (0.3386*t6 + 1.06247 - 1.554*n_dot_v)*f32::max(roughness, t7);
    let t9 = t8 + (n_dot_v - 0.2081*t4 + 0.4488*t7);
    let t10 = (t9 - 2.07367)*(t9 + 0.02464*n_dot_v) + 1.09734;
    let t11 = 1.6*f32::clamp(0.137*n_dot_v + (roughness*t2 - 0.03), 0.0, 1.0) - 0.122;
    let t12 = f32::clamp(n_dot_v*t6 + 0.9941, 0.0, 1.0) + roughness*t11;
    let t13 = (4.50282 - 5.5*(t1 + 0.113*roughness))*(t10 + 0.06435*t2) + t12;
    let scale = f32::clamp(t13, 0.0, 1.0);
    let bias = t1*t10;
    (scale, bias)
}
