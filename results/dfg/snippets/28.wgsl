// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 27 cycles on gcn
// error: RMSE 0.00437, max 0.07594 on the search split
//        RMSE 0.00439, max 0.09900 on the validation split
//        scale: RMSE 0.00469, max 0.02893
//        bias: RMSE 0.00403, max 0.07594
// finite on every sample of both splits
// t0 = saturate(saturate(n_dot_v + (1.05 - 0.85*roughness)) - 1.3*n_dot_v); t1 = n_dot_v*roughness; t2 = abs(roughness*(1.12*roughness - 1.85) + 0.9959) - 1.125*n_dot_v - t1*(1.55*roughness - 2.246); t3 = (1.16 - 2*(roughness*(50*t1 + 0.287)))*(0.0000772*(n_dot_v*(145 - 100*roughness)) - 0.0107) + 0.01367; t4 = saturate(t3 - 0.04795*n_dot_v); bias = saturate(t0*(t0 + 3.3*roughness)*(t2^2 + 0.0048)); scale = t4*(t4 - 1.6719) + 0.99702 + bias*(t3*(bias*(366.4*n_dot_v - 92.7) - 15.6843) - 0.855428)
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = saturate(saturate(n_dot_v + (1.05 - 0.85*roughness)) - 1.3*n_dot_v);
    let t1 = n_dot_v*roughness;
    let t2 = abs(roughness*(1.12*roughness - 1.85) + 0.9959) - 1.125*n_dot_v;
    let t3 = t2 - t1*(1.55*roughness - 2.246);
    let t4 = 0.0000772*(n_dot_v*(145.0 - 100.0*roughness)) - 0.0107;
    let t5 = (1.16 - 2.0*(roughness*(50.0*t1 + 0.287)))*t4 + 0.01367;
    let t6 = saturate(t5 - 0.04795*n_dot_v);
    let bias = saturate(t0*(t0 + 3.3*roughness)*(t3*t3 + 0.0048));
    let t7 = bias*(t5*(bias*(366.4*n_dot_v - 92.7) - 15.6843) - 0.855428);
    let scale = t6*(t6 - 1.6719) + 0.99702 + t7;
    return vec2<f32>(scale, bias);
}
