// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 15 cycles on gcn
// error: RMSE 0.00841, max 0.10163 on the search split
//        RMSE 0.00844, max 0.10378 on the validation split
//        scale: RMSE 0.00941, max 0.05379
//        bias: RMSE 0.00727, max 0.10163
// finite on every sample of both splits
// t0 = 1.2*roughness - 0.11; t1 = max(n_dot_v, t0); t2 = n_dot_v*(2.8*t1 - 5.3); t3 = (0.209 - 0.095*t1)*(t2 - 0.81*t0 - 5.7*t1) + 0.958; bias = t3^2; scale = (t0*(t1 + (t2 + 0.5)*(n_dot_v - 1.8*roughness)) + 0.51)*(-2.1*bias - 0.2525) + 1.136
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = 1.2*roughness - 0.11;
    let t1 = max(n_dot_v, t0);
    let t2 = n_dot_v*(2.8*t1 - 5.3);
    let t3 = (0.209 - 0.095*t1)*(t2 - 0.81*t0 - 5.7*t1) + 0.958;
    let bias = t3*t3;
    let t4 = t0*(t1 + (t2 + 0.5)*(n_dot_v - 1.8*roughness)) + 0.51;
    let scale = t4*(-2.1*bias - 0.2525) + 1.136;
    return vec2<f32>(scale, bias);
}
