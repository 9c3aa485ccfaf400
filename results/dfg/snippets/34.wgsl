// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 33 cycles on gcn
// error: RMSE 0.00333, max 0.04570 on the search split
//        RMSE 0.00343, max 0.07120 on the validation split
//        scale: RMSE 0.00363, max 0.03485
//        bias: RMSE 0.00300, max 0.04570
// finite on every sample of both splits
// t0 = saturate(1.04 - 0.7*roughness + 0.52*n_dot_v) - 0.9*n_dot_v; t1 = n_dot_v + 8*roughness; t2 = t1 + 0.6; t3 = roughness*(0.486*t2 - 2.876) + 0.32473 - 0.412*n_dot_v; t4 = t3 - min(roughness, 0.937*roughness + 0.177*n_dot_v)*(3.8*roughness - 2.21); bias = t0*(t0*(20*roughness + 13) - 3.7)*t4^2; t5 = (10.4 - 100*((roughness - 0.444*n_dot_v)*(n_dot_v*roughness + 0.033)))*(-0.0049*t0 - 0.001 - 0.00235*n_dot_v); t6 = t5 + 0.059; scale = saturate(t1*(t6*(t5 - 0.52345)) + 1.00123 + bias*(1.207*t3 - 1.47746 - 60*(t6 - 0.007197*t2 + 0.00588*bias)))
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = saturate(1.04 - 0.7*roughness + 0.52*n_dot_v) - 0.9*n_dot_v;
    let t1 = n_dot_v + 8.0*roughness;
    let t2 = t1 + 0.6;
    let t3 = roughness*(0.486*t2 - 2.876) + 0.32473 - 0.412*n_dot_v;
    let t4 = min(roughness, 0.937*roughness + 0.177*n_dot_v)*(3.8*roughness - 2.21);
    let t5 = t3 - t4;
    let bias = t0*(t0*(20.0*roughness + 13.0) - 3.7)*(t5*t5);
    let t6 = 10.4 - 100.0*((roughness - 0.444*n_dot_v)*(n_dot_v*roughness + 0.033));
    let t7 = t6*(-0.0049*t0 - 0.001 - 0.00235*n_dot_v);
    let t8 = t7 + 0.059;
    let t9 = bias*(1.207*t3 - 1.47746 - 60.0*(t8 - 0.007197*t2 + 0.00588*bias));
    let scale = saturate(t1*(t8*(t7 - 0.52345)) + 1.00123 + t9);
    return vec2<f32>(scale, bias);
}
