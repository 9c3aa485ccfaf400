// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 6 cycles on gcn
// error: RMSE 0.02833, max 0.16504 on the search split
//        RMSE 0.02827, max 0.16502 on the validation split
//        scale: RMSE 0.03194, max 0.15116
//        bias: RMSE 0.02419, max 0.16504
// finite on every sample of both splits
// t0 = saturate(saturate(2.1 - 2*roughness) - 2.4*n_dot_v); t1 = 0.83 - 1.37*roughness; scale = saturate(t1*(n_dot_v - 0.78*t0) + 0.77); bias = t0*abs(t1) + 0.01
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = f32::clamp(2.1 - 2.0*roughness, 0.0, 1.0) - 2.4*n_dot_v;
    let t1 = f32::clamp(t0, 0.0, 1.0);
    let t2 = 0.83 - 1.37*roughness;
    let scale = f32::clamp(t2*(n_dot_v - 0.78*t1) + 0.77, 0.0, 1.0);
    let bias = t1*f32::abs(t2) + 0.01;
    (scale, bias)
}
