// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 8 cycles on gcn
// error: RMSE 0.02495, max 0.12218 on the search split
//        RMSE 0.02493, max 0.12979 on the validation split
//        scale: RMSE 0.02702, max 0.12218
//        bias: RMSE 0.02269, max 0.11369
// finite on every sample of both splits
// t0 = 1.03*n_dot_v - 0.97; t1 = t0*(t0 + 0.9*roughness) + 0.043; bias = t1^2 + 0.005; scale = min(0.7733 - (1.34*roughness - 0.81)*(n_dot_v + t0*t1), 0.986)
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = 1.03*n_dot_v - 0.97;
    let t1 = t0*(t0 + 0.9*roughness) + 0.043;
    let bias = t1*t1 + 0.005;
    let scale = min(0.7733 - (1.34*roughness - 0.81)*(n_dot_v + t0*t1), 0.986);
    return vec2<f32>(scale, bias);
}
