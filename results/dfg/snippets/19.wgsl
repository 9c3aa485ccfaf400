// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 18 cycles on gcn
// error: RMSE 0.00676, max 0.04800 on the search split
//        RMSE 0.00678, max 0.06360 on the validation split
//        scale: RMSE 0.00786, max 0.04189
//        bias: RMSE 0.00543, max 0.04800
// finite on every sample of both splits
// t0 = roughness - 0.5*n_dot_v; bias = exp2((t0^2 - 0.06)*(10*t0 - 13.5) - (n_dot_v*(7*n_dot_v + 6.2) + 0.874)); t1 = roughness - 0.27*n_dot_v; t2 = n_dot_v*(t1*max(t1, -0.03) - 0.0134); t3 = 0.8937 - 1.033*t2; scale = t3*(t3 + bias*(-24*t2 - 1.163)) + 0.1866
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = roughness - 0.5*n_dot_v;
    let t1 = (t0*t0 - 0.06)*(10.0*t0 - 13.5) - (n_dot_v*(7.0*n_dot_v + 6.2) + 0.874);
    let bias = exp2(t1);
    let t2 = roughness - 0.27*n_dot_v;
    let t3 = n_dot_v*(t2*max(t2, -0.03) - 0.0134);
    let t4 = 0.8937 - 1.033*t3;
    let scale = t4*(t4 + bias*(-24.0*t3 - 1.163)) + 0.1866;
    return vec2<f32>(scale, bias);
}
