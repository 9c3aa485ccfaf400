// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 36 cycles on gcn
// error: RMSE 0.00282, max 0.03181 on the search split
//        RMSE 0.00294, max 0.07150 on the validation split
//        scale: RMSE 0.00312, max 0.02931
//        bias: RMSE 0.00247, max 0.03181
// finite on every sample of both splits
// t0 = saturate(1.024 - 0.6*roughness + 0.45*n_dot_v) - 1.2*n_dot_v; t1 = n_dot_v + 7*roughness; t2 = t1 + 0.7; t3 = roughness*(0.545*t2 - 2.75) + 0.3033 - 0.392*n_dot_v; t4 = t3 - min(roughness, saturate(0.916*roughness + n_dot_v*(0.234 - 0.16*n_dot_v)))*(3.8*roughness - 2.07); bias = t4^2*(t0*(t0*(23*roughness + 7 - 28*(roughness^2 - 0.06)) + 1.8) + 0.18); t5 = (9 - 100*((roughness - 0.44*n_dot_v)*(n_dot_v*roughness + 0.032)))*(1e-5 - 0.0067*t0 - 0.0049*n_dot_v); t6 = t5 + 0.0507; scale = t1*(t6*(t5 - 0.603)) + 1.0006 + bias*(0.997*t3 - 1.7695 - 55*(t6 - 0.00754*t2 + 0.0069*bias))
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = saturate(1.024 - 0.6*roughness + 0.45*n_dot_v) - 1.2*n_dot_v;
    const float t1 = n_dot_v + 7.0*roughness;
    const float t2 = t1 + 0.7;
    const float t3 = roughness*(0.545*t2 - 2.75) + 0.3033 - 0.392*n_dot_v;
    const float t4 = saturate(0.916*roughness + n_dot_v*(0.234 - 0.16*n_dot_v));
    const float t5 = t3 - min(roughness, t4)*(3.8*roughness - 2.07);
    const float t6 = t0*(t0*(23.0*roughness + 7.0 - 28.0*(roughness*roughness - 0.06)) + 1.8);
    const float bias = t5*t5*(t6 + 0.18);
    const float t7 = 9.0 - 100.0*((roughness - 0.44*n_dot_v)*(n_dot_v*roughness + 0.032));
    const float t8 = t7*(1e-5 - 0.0067*t0 - 0.0049*n_dot_v);
    const float t9 = t8 + 0.0507;
    const float t10 = bias*(0.997*t3 - 1.7695 - 55.0*(t9 - 0.00754*t2 + 0.0069*bias));
    const float scale = t1*(t9*(t8 - 0.603)) + 1.0006 + t10;
    return float2(scale, bias);
}
