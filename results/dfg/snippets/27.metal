// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 26 cycles on gcn
// error: RMSE 0.00473, max 0.06822 on the search split
//        RMSE 0.00479, max 0.08057 on the validation split
//        scale: RMSE 0.00523, max 0.03077
//        bias: RMSE 0.00417, max 0.06822
// finite on every sample of both splits
// t0 = 0.68 - 1.1*roughness; t1 = 1.74*n_dot_v - 2.18; t2 = roughness*t1 + 0.15; t3 = t2 + n_dot_v*abs(n_dot_v*(n_dot_v - 2.65) + 1.652); t4 = 0.3*t3 + 1.124 - 1.47*n_dot_v; t5 = 0.48*t1 + 1.1086; t6 = saturate(t4*max(roughness, t5) + (n_dot_v - 0.184*t2 + 0.34*t5)); bias = (t6 - 2.0976)*(t6 + 0.0193*n_dot_v) + 1.1162; scale = saturate((saturate(n_dot_v*t0 + 1.014 - 0.14*roughness)*(0.8*n_dot_v + (0.43*t0 - 10)) + 8.7544)*(bias + (0.0956*t4 - 0.03323)) + (saturate(n_dot_v*t3 + 1) - 0.0919*roughness))
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = 0.68 - 1.1*roughness;
    const float t1 = 1.74*n_dot_v - 2.18;
    const float t2 = roughness*t1 + 0.15;
    const float t3 = t2 + n_dot_v*abs(n_dot_v*(n_dot_v - 2.65) + 1.652);
    const float t4 = 0.3*t3 + 1.124 - 1.47*n_dot_v;
    const float t5 = 0.48*t1 + 1.1086;
    const float t6 = saturate(t4*max(roughness, t5) + (n_dot_v - 0.184*t2 + 0.34*t5));
    const float bias = (t6 - 2.0976)*(t6 + 0.0193*n_dot_v) + 1.1162;
    const float t7 = saturate(n_dot_v*t0 + 1.014 - 0.14*roughness);
    const float t8 = t7*(0.8*n_dot_v + (0.43*t0 - 10.0)) + 8.7544;
    const float t9 = saturate(n_dot_v*t3 + 1.0) - 0.0919*roughness;
    const float scale = saturate(t8*(bias + (0.0956*t4 - 0.03323)) + t9);
    return float2(scale, bias);
}
