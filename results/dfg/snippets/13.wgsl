// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 12 cycles on gcn
// error: RMSE 0.01092, max 0.06895 on the search split
//        RMSE 0.01095, max 0.08550 on the validation split
//        scale: RMSE 0.01315, max 0.06373
//        bias: RMSE 0.00809, max 0.06895
// finite on every sample of both splits
// t0 = 1.8*n_dot_v - 1.23; t1 = saturate(t0*max(n_dot_v, max(roughness, 0.05)) + 0.995 - 1.4*n_dot_v); bias = t1^2 - 0.033*t0; scale = saturate(n_dot_v*(roughness*(n_dot_v*(1.84 - 0.8*n_dot_v) + (-0.5*roughness - 1.6)) + 0.385) + 0.942) - 1.005*abs(bias)
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = 1.8*n_dot_v - 1.23;
    let t1 = saturate(t0*max(n_dot_v, max(roughness, 0.05)) + 0.995 - 1.4*n_dot_v);
    let bias = t1*t1 - 0.033*t0;
    let t2 = roughness*(n_dot_v*(1.84 - 0.8*n_dot_v) + (-0.5*roughness - 1.6));
    let scale = saturate(n_dot_v*(t2 + 0.385) + 0.942) - 1.005*abs(bias);
    return vec2<f32>(scale, bias);
}
