// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 29 cycles on gcn
// error: RMSE 0.00417, max 0.06384 on the search split
//        RMSE 0.00422, max 0.10043 on the validation split
//        scale: RMSE 0.00469, max 0.03307
//        bias: RMSE 0.00358, max 0.06384
// finite on every sample of both splits
// t0 = saturate(saturate(1.04 - 0.9*roughness + 1.18*n_dot_v) - 1.35*n_dot_v); t1 = t0 + 3.8*roughness; t2 = n_dot_v*roughness; t3 = abs(roughness*(1.24*roughness - 1.773) + 1.031) - 1.173*n_dot_v - t2*(1.35*roughness - 2.08); bias = t0*t1*(t3*(t3 - 0.101*t1) + 0.0322); t4 = (0.0000594*(n_dot_v*(148 - 100*roughness)) - 0.00833)*(2.2 - 3*(roughness*(50*t2 + 0.4)) + 17*t2) + 0.02; t5 = saturate(t4 - 0.0397*n_dot_v); scale = t5*(t5 - 1.659) + 0.997 + bias*(t4*(bias*(200*n_dot_v - 104) - 13.9) - 0.773)
vec2 dfg(float n_dot_v, float roughness) {
    float t0 = clamp(1.04 - 0.9*roughness + 1.18*n_dot_v, 0.0, 1.0) - 1.35*n_dot_v;
    float t1 = clamp(t0, 0.0, 1.0);
    float t2 = t1 + 3.8*roughness;
    float t3 = n_dot_v*roughness;
    float t4 = abs(roughness*(1.24*roughness - 1.773) + 1.031) - 1.173*n_dot_v;
    float t5 = t4 - t3*(1.35*roughness - 2.08);
    float bias = t1*t2*(t5*(t5 - 0.101*t2) + 0.0322);
    float t6 = 0.0000594*(n_dot_v*(148.0 - 100.0*roughness)) - 0.00833;
    float t7 = t6*(2.2 - 3.0*(roughness*(50.0*t3 + 0.4)) + 17.0*t3) + 0.02;
    float t8 = clamp(t7 - 0.0397*n_dot_v, 0.0, 1.0);
    float t9 = bias*(t7*(bias*(200.0*n_dot_v - 104.0) - 13.9) - 0.773);
    float scale = t8*(t8 - 1.659) + 0.997 + t9;
    return vec2(scale, bias);
}
