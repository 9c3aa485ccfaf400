// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 26 cycles on gcn
// error: RMSE 0.00560, max 0.07719 on the search split
//        RMSE 0.00562, max 0.09978 on the validation split
//        scale: RMSE 0.00623, max 0.04835
//        bias: RMSE 0.00489, max 0.07719
// finite on every sample of both splits
// t0 = n_dot_v + 0.04; t1 = 0.765*(roughness + 0.51*n_dot_v); bias = exp2((-6.3*t0 - 6.3)*max(t0, t1) + 0.233); scale = min(0.7558 - (exp2(-4.35*max(n_dot_v, 0.61*roughness - 0.064) - 7.9*n_dot_v) - 0.1236)*((roughness - 0.73)*(-1.43*roughness - 2.28 - 7.4*min(n_dot_v, t1)) - 0.805), 0.994)
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = n_dot_v + 0.04;
    let t1 = 0.765*(roughness + 0.51*n_dot_v);
    let bias = exp2((-6.3*t0 - 6.3)*max(t0, t1) + 0.233);
    let t2 = (roughness - 0.73)*(-1.43*roughness - 2.28 - 7.4*min(n_dot_v, t1));
    let t3 = exp2(-4.35*max(n_dot_v, 0.61*roughness - 0.064) - 7.9*n_dot_v) - 0.1236;
    let scale = min(0.7558 - t3*(t2 - 0.805), 0.994);
    return vec2<f32>(scale, bias);
}
