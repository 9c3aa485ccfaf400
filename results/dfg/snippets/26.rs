// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 25 cycles on gcn
// error: RMSE 0.00501, max 0.06580 on the search split
//        RMSE 0.00508, max 0.07883 on the validation split
//        scale: RMSE 0.00542, max 0.03010
//        bias: RMSE 0.00457, max 0.06580
// finite on every sample of both splits
// t0 = 1.9*n_dot_v - 2.3; t1 = roughness*t0 + 0.22; t2 = t1 + n_dot_v*(n_dot_v*(n_dot_v - 2.63) + 1.553); t3 = 0.3*t2 + 1.125 - 1.46*n_dot_v; t4 = 0.42*t0 + 1.027; t5 = t3*max(roughness, t4) + (n_dot_v - 0.16*t1 + 0.38*t4); bias = t5*(t5 - 2.097) + 1.1014; scale = (saturate(n_dot_v*(0.087 - 0.14*roughness) + 1.002 - 0.02*roughness)*(0.9*(n_dot_v - 0.5*roughness) - 70) + 69.078)*(bias + (0.1246*t3 - 0.0362)) + (saturate(n_dot_v*t2 + 0.993) - 0.081*roughness)
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = 1.9*n_dot_v - 2.3;
    let t1 = roughness*t0 + 0.22;
    let t2 = t1 + n_dot_v*(n_dot_v*(n_dot_v - 2.63) + 1.553);
    let t3 = 0.3*t2 + 1.125 - 1.46*n_dot_v;
    let t4 = 0.42*t0 + 1.027;
    let t5 = t3*f32::max(roughness, t4) + (n_dot_v - 0.16*t1 + 0.38*t4);
    let bias = t5*(t5 - 2.097) + 1.1014;
    let t6 = n_dot_v*(0.087 - 0.14*roughness) + 1.002 - 0.02*roughness;
    let t7 = f32::clamp(t6, 0.0, 1.0)*(0.9*(n_dot_v - 0.5*roughness) - 70.0) + 69.078;
    let t8 = f32::clamp(n_dot_v*t2 + 0.993, 0.0, 1.0) - 0.081*roughness;
    let scale = t7*(bias + (0.1246*t3 - 0.0362)) + t8;
    (scale, bias)
}
