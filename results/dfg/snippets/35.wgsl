// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 34 cycles on gcn
// error: RMSE 0.00314, max 0.03536 on the search split
//        RMSE 0.00327, max 0.07697 on the validation split
//        scale: RMSE 0.00350, max 0.03536
//        bias: RMSE 0.00272, max 0.03406
// finite on every sample of both splits
// t0 = saturate(1.03 - 0.76*roughness + 0.58*n_dot_v) - 1.3*n_dot_v; t1 = n_dot_v*roughness; t2 = saturate(t0 + 0.26*t1); t3 = n_dot_v + 9*roughness; t4 = t3 + 0.6; t5 = roughness*(0.4427*t4 - 2.869) + 0.2848 - 0.338*n_dot_v; t6 = t5 - min(roughness, 0.943*roughness + abs(-0.154*n_dot_v))*(3.9*roughness - 2.26); bias = t6^2*((t2*(30*roughness + 10) + 2)*t2 + 0.11); t7 = (11.4 - 100*(t1*(roughness - 0.446*n_dot_v)))*(-0.0044*t0 - 0.00157 - 0.00394*n_dot_v); t8 = t7 + 0.069; scale = t3*(t8*(t7 - 0.4593)) + 1.006 + bias*(1.218*t5 - 1.0273 - 58.4*(t8 - 0.004674*t4 + 0.00805*bias))
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = saturate(1.03 - 0.76*roughness + 0.58*n_dot_v) - 1.3*n_dot_v;
    let t1 = n_dot_v*roughness;
    let t2 = saturate(t0 + 0.26*t1);
    let t3 = n_dot_v + 9.0*roughness;
    let t4 = t3 + 0.6;
    let t5 = roughness*(0.4427*t4 - 2.869) + 0.2848 - 0.338*n_dot_v;
    let t6 = min(roughness, 0.943*roughness + abs(-0.154*n_dot_v));
    let t7 = t5 - t6*(3.9*roughness - 2.26);
    let bias = t7*t7*((t2*(30.0*roughness + 10.0) + 2.0)*t2 + 0.11);
    let t8 = 11.4 - 100.0*(t1*(roughness - 0.446*n_dot_v));
    let t9 = t8*(-0.0044*t0 - 0.00157 - 0.00394*n_dot_v);
    let t10 = t9 + 0.069;
    let t11 = bias*(1.218*t5 - 1.0273 - 58.4*(t10 - 0.004674*t4 + 0.00805*bias));
    let scale = t3*(t10*(t9 - 0.4593)) + 1.006 + t11;
    return vec2<f32>(scale, bias);
}
