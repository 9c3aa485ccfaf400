// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 16 cycles on gcn
// error: RMSE 0.00828, max 0.07386 on the search split
//        RMSE 0.00832, max 0.07229 on the validation split
//        scale: RMSE 0.00975, max 0.04498
//        bias: RMSE 0.00647, max 0.07386
// finite on every sample of both splits
// t0 = n_dot_v - 0.9*roughness; t1 = saturate(roughness*(n_dot_v*(-t0 - 0.26) - 0.03) + 1.05 + 0.79*t0); t2 = saturate(t1 - 1.59*(n_dot_v + 0.1*roughness)); bias = t2*((t1*t2 - 0.19)*t2 + 0.1512) + 0.00425; scale = saturate(n_dot_v*(roughness*(0.766*n_dot_v + (t1 - 2.56)) + 0.373) + 0.9675) + bias*(-0.413*roughness - 0.991)
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = n_dot_v - 0.9*roughness;
    let t1 = roughness*(n_dot_v*(-t0 - 0.26) - 0.03) + 1.05 + 0.79*t0;
    let t2 = f32::clamp(t1, 0.0, 1.0);
    let t3 = f32::clamp(t2 - 1.59*(n_dot_v + 0.1*roughness), 0.0, 1.0);
    let bias = t3*((t2*t3 - 0.19)*t3 + 0.1512) + 0.00425;
    let t4 = n_dot_v*(roughness*(0.766*n_dot_v + (t2 - 2.56)) + 0.373) + 0.9675;
    let scale = f32::clamp(t4, 0.0, 1.0) + bias*(-0.413*roughness - 0.991);
    (scale, bias)
}
