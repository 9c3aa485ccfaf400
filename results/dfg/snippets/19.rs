// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 18 cycles on gcn
// error: RMSE 0.00714, max 0.06675 on the search split
//        RMSE 0.00720, max 0.08502 on the validation split
//        scale: RMSE 0.00871, max 0.06675
//        bias: RMSE 0.00510, max 0.06276
// finite on every sample of both splits
// t0 = 0.47*n_dot_v + (-0.2*roughness - 1.4); t1 = roughness*t0; t2 = t1 + 0.604; t3 = saturate(n_dot_v - 0.69*(t1 + 0.1) + (0.57*t2 + 0.3 - 0.57*n_dot_v)*max(roughness, 4.4*t0 + 6.286)); bias = t3*(t3 - 1.995) + 0.995; scale = bias*(7.457 - 8.4*saturate(n_dot_v*roughness + 1.1 - 0.37*roughness)) + (saturate(n_dot_v*t2 + 0.894) - 0.0614*roughness)
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = 0.47*n_dot_v + (-0.2*roughness - 1.4);
    let t1 = roughness*t0;
    let t2 = t1 + 0.604;
    let t3 = (0.57*t2 + 0.3 - 0.57*n_dot_v)*f32::max(roughness, 4.4*t0 + 6.286);
    let t4 = f32::clamp(n_dot_v - 0.69*(t1 + 0.1) + t3, 0.0, 1.0);
    let bias = t4*(t4 - 1.995) + 0.995;
    let t5 = 8.4*f32::clamp(n_dot_v*roughness + 1.1 - 0.37*roughness, 0.0, 1.0);
    let t6 = f32::clamp(n_dot_v*t2 + 0.894, 0.0, 1.0) - 0.0614*roughness;
    let scale = bias*(7.457 - t5) + t6;
    (scale, bias)
}
