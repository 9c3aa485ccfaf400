// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 32 cycles on gcn
// error: RMSE 0.00351, max 0.04375 on the search split
//        RMSE 0.00361, max 0.07488 on the validation split
//        scale: RMSE 0.00392, max 0.03930
//        bias: RMSE 0.00303, max 0.04375
// finite on every sample of both splits
// t0 = saturate(1.035 - 0.65*roughness + 0.5*n_dot_v) - 0.9*n_dot_v; t1 = n_dot_v + 16*roughness; t2 = t1 - 0.06; t3 = 0.969*roughness; t4 = t3*(0.3129*t2 - 3.178) + 0.2049 - 0.256*n_dot_v; t5 = t4 - min(roughness, t3 + 0.088*n_dot_v)*(4.8*roughness - 2.86); bias = t5^2*(t0*(t0*(50*roughness + 35) - 12) + 0.48); t6 = (-100*((roughness - 0.4*n_dot_v)*(n_dot_v*roughness + 0.0793) - 0.09) - 1.1)*(-0.00344*t0 - 0.000497 - 0.001704*n_dot_v); t7 = t6 + 0.0271; scale = t1*(t7*(t6 - 0.39174)) + 0.99288 + bias*(0.717*t4 - 1.4764 - 86*(t7 - 0.003174*t2))
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = saturate(1.035 - 0.65*roughness + 0.5*n_dot_v) - 0.9*n_dot_v;
    const float t1 = n_dot_v + 16.0*roughness;
    const float t2 = t1 - 0.06;
    const float t3 = 0.969*roughness;
    const float t4 = t3*(0.3129*t2 - 3.178) + 0.2049 - 0.256*n_dot_v;
    const float t5 = t4 - min(roughness, t3 + 0.088*n_dot_v)*(4.8*roughness - 2.86);
    const float bias = t5*t5*(t0*(t0*(50.0*roughness + 35.0) - 12.0) + 0.48);
    const float t6 = -100.0*((roughness - 0.4*n_dot_v)*(n_dot_v*roughness + 0.0793) - 0.09);
    const float t7 = (t6 - 1.1)*(-0.00344*t0 - 0.000497 - 0.001704*n_dot_v);
    const float t8 = t7 + 0.0271;
    const float t9 = bias*(0.717*t4 - 1.4764 - 86.0*(t8 - 0.003174*t2));
    const float scale = t1*(t8*(t7 - 0.39174)) + 0.99288 + t9;
    return float2(scale, bias);
}
