// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 38 cycles on gcn
// error: RMSE 0.00264, max 0.03155 on the search split
//        RMSE 0.00278, max 0.07101 on the validation split
//        scale: RMSE 0.00281, max 0.02710
//        bias: RMSE 0.00246, max 0.03155
// finite on every sample of both splits
// t0 = saturate(1.014 - 0.4*roughness + 0.317*n_dot_v) - 1.2*n_dot_v; t1 = roughness*(20 - 20*roughness) + 4.9; t2 = n_dot_v + 4.78*roughness; t3 = t2 + 0.9; t4 = roughness*(0.6974*t3 - 2.657) + 0.3774 - 0.464*n_dot_v; t5 = t4 - min(roughness, saturate(0.86*roughness + n_dot_v*(0.398 - 0.28*n_dot_v)))*(3.33*roughness - 1.705); bias = t5^2*(t0*(t0*(t1 - 1.13*(roughness*t1 - 1.46)) + 0.31) + 0.02); t6 = (19.3 - 300*((roughness - 0.452*n_dot_v)*(n_dot_v*roughness + 0.0326)))*(0.00192 - 0.00523*t0 - 0.0045*n_dot_v); t7 = t6 + 0.0455; t8 = t7 - 0.01407*t3; scale = t2*(t7*(t6 - 0.793)) + 1.0152 + bias*(t4 - 2.4215 - 41.6*(t8 + 0.00634*bias)) + 0.663*t8
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = saturate(1.014 - 0.4*roughness + 0.317*n_dot_v) - 1.2*n_dot_v;
    let t1 = roughness*(20.0 - 20.0*roughness) + 4.9;
    let t2 = n_dot_v + 4.78*roughness;
    let t3 = t2 + 0.9;
    let t4 = roughness*(0.6974*t3 - 2.657) + 0.3774 - 0.464*n_dot_v;
    let t5 = saturate(0.86*roughness + n_dot_v*(0.398 - 0.28*n_dot_v));
    let t6 = t4 - min(roughness, t5)*(3.33*roughness - 1.705);
    let bias = t6*t6*(t0*(t0*(t1 - 1.13*(roughness*t1 - 1.46)) + 0.31) + 0.02);
    let t7 = 19.3 - 300.0*((roughness - 0.452*n_dot_v)*(n_dot_v*roughness + 0.0326));
    let t8 = t7*(0.00192 - 0.00523*t0 - 0.0045*n_dot_v);
    let t9 = t8 + 0.0455;
    let t10 = t9 - 0.01407*t3;
    let t11 = bias*(t4 - 2.4215 - 41.6*(t10 + 0.00634*bias));
    let scale = t2*(t9*(t8 - 0.793)) + 1.0152 + t11 + 0.663*t10;
    return vec2<f32>(scale, bias);
}
