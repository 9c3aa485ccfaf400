// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 31 cycles on gcn
// error: RMSE 0.00384, max 0.04811 on the search split
//        RMSE 0.00392, max 0.06666 on the validation split
//        scale: RMSE 0.00424, max 0.03203
//        bias: RMSE 0.00340, max 0.04811
// finite on every sample of both splits
// t0 = saturate(1.05 - 0.8*roughness + 0.614*n_dot_v) - 0.95*n_dot_v; t1 = n_dot_v + 5*roughness + 1; t2 = 0.902*roughness + 0.292*n_dot_v; t3 = roughness*(0.5587*t1 - 2.4714) + 0.3514 - 0.471*n_dot_v; t4 = t3 - min(roughness, t2)*(2.69*roughness - 1.51); bias = t4^2*(t0*(t0 + t0*(16*roughness + 7)) - 0.076); t5 = (15.1 - 200*((roughness - 0.405*n_dot_v)*(n_dot_v*roughness + 0.0826)))*(-0.00312*t0 - 0.00429); t6 = t5 + 0.0748; scale = saturate(t2*(t6*(t5 - 1.535)) + 0.98007 + bias*(1.095*t3 - 3.0464 - 23.09*(t6 - 0.03538*t1)))
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = saturate(1.05 - 0.8*roughness + 0.614*n_dot_v) - 0.95*n_dot_v;
    const float t1 = n_dot_v + 5.0*roughness + 1.0;
    const float t2 = 0.902*roughness + 0.292*n_dot_v;
    const float t3 = roughness*(0.5587*t1 - 2.4714) + 0.3514 - 0.471*n_dot_v;
    const float t4 = t3 - min(roughness, t2)*(2.69*roughness - 1.51);
    const float bias = t4*t4*(t0*(t0 + t0*(16.0*roughness + 7.0)) - 0.076);
    const float t5 = 15.1 - 200.0*((roughness - 0.405*n_dot_v)*(n_dot_v*roughness + 0.0826));
    const float t6 = t5*(-0.00312*t0 - 0.00429);
    const float t7 = t6 + 0.0748;
    const float t8 = bias*(1.095*t3 - 3.0464 - 23.09*(t7 - 0.03538*t1));
    const float scale = saturate(t2*(t7*(t6 - 1.535)) + 0.98007 + t8);
    return float2(scale, bias);
}
