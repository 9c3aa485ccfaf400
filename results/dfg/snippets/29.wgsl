// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 28 cycles on gcn
// error: RMSE 0.00431, max 0.06584 on the search split
//        RMSE 0.00435, max 0.10248 on the validation split
//        scale: RMSE 0.00484, max 0.03004
//        bias: RMSE 0.00370, max 0.06584
// finite on every sample of both splits
// t0 = saturate(saturate(1.04 - 0.87*roughness + 1.14*n_dot_v) - 1.3*n_dot_v); t1 = t0 + 3.6*roughness; t2 = n_dot_v*roughness; t3 = abs(roughness*(1.18*roughness - 1.79) + 1.026) - 1.194*n_dot_v - t2*(1.5*roughness - 2.25); t4 = (1.2 - 2*(roughness*(50*t2 + 0.35)))*(0.0000772*(n_dot_v*(144 - 100*roughness)) - 0.01061) + 0.01417; t5 = saturate(t4 - 0.0488*n_dot_v); bias = saturate(t0*t1*(t3*(t3 - 0.072*t1) + 0.0172)); scale = t5*(t5 - 1.675) + 0.99704 + bias*(t4*(bias*(315*n_dot_v - 85.46) - 15.363) - 0.8442)
fn dfg(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    let t0 = saturate(saturate(1.04 - 0.87*roughness + 1.14*n_dot_v) - 1.3*n_dot_v);
    let t1 = t0 + 3.6*roughness;
    let t2 = n_dot_v*roughness;
    let t3 = abs(roughness*(1.18*roughness - 1.79) + 1.026) - 1.194*n_dot_v;
    let t4 = t3 - t2*(1.5*roughness - 2.25);
    let t5 = 0.0000772*(n_dot_v*(144.0 - 100.0*roughness)) - 0.01061;
    let t6 = (1.2 - 2.0*(roughness*(50.0*t2 + 0.35)))*t5 + 0.01417;
    let t7 = saturate(t6 - 0.0488*n_dot_v);
    let bias = saturate(t0*t1*(t4*(t4 - 0.072*t1) + 0.0172));
    let t8 = bias*(t6*(bias*(315.0*n_dot_v - 85.46) - 15.363) - 0.8442);
    let scale = t7*(t7 - 1.675) + 0.99704 + t8;
    return vec2<f32>(scale, bias);
}
