// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 29 cycles on gcn
// error: RMSE 0.00513, max 0.07405 on the search split
//        RMSE 0.00514, max 0.07791 on the validation split
//        scale: RMSE 0.00596, max 0.04110
//        bias: RMSE 0.00414, max 0.07405
// finite on every sample of both splits
// t0 = n_dot_v + 0.05; t1 = 0.71*(roughness + 0.57*n_dot_v); bias = exp2((-7*t0 - 5.4)*max(t0, t1) - roughness + 0.255); t2 = 0.67*roughness; scale = min(0.75622 - 0.24793*((exp2(max(n_dot_v, t2 - 0.078)*(t2 - 4.68) - 7.7*n_dot_v) - 0.1228)*((roughness - 0.736)*(-6.32*roughness - 9.42 - 30*min(n_dot_v, t1)) - 3.4783)), 0.99403)
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = n_dot_v + 0.05;
    let t1 = 0.71*(roughness + 0.57*n_dot_v);
    let bias = exp2((-7.0*t0 - 5.4)*max(t0, t1) - roughness + 0.255);
    let t2 = 0.67*roughness;
    let t3 = (roughness - 0.736)*(-6.32*roughness - 9.42 - 30.0*min(n_dot_v, t1));
    let t4 = exp2(max(n_dot_v, t2 - 0.078)*(t2 - 4.68) - 7.7*n_dot_v) - 0.1228;
    let scale = min(0.75622 - 0.24793*(t4*(t3 - 3.4783)), 0.99403);
    return vec2<f32>(scale, bias);
}
