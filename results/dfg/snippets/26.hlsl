// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 25 cycles on gcn
// error: RMSE 0.00501, max 0.06614 on the search split
//        RMSE 0.00507, max 0.07685 on the validation split
//        scale: RMSE 0.00541, max 0.02931
//        bias: RMSE 0.00458, max 0.06614
// finite on every sample of both splits
// t0 = 1.9*n_dot_v - 2.3; t1 = roughness*t0 + 0.2; t2 = t1 + n_dot_v*(n_dot_v*(n_dot_v - 2.64) + 1.58); t3 = 0.3*t2 + 1.13 - 1.46*n_dot_v; t4 = 0.42*t0 + 1.028; t5 = t3*max(roughness, t4) + (n_dot_v - 0.16*t1 + 0.376*t4); bias = t5*(t5 - 2.104) + 1.1086; scale = (saturate(n_dot_v*(0.074 - 0.12*roughness) + 1.0015 - 0.016*roughness)*(0.9*(n_dot_v - 0.5*roughness) - 84) + 83.072)*(bias + (0.122*t3 - 0.0359)) + (saturate(n_dot_v*t2 + 0.997) - 0.0804*roughness)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = 1.9*n_dot_v - 2.3;
    const float t1 = roughness*t0 + 0.2;
    const float t2 = t1 + n_dot_v*(n_dot_v*(n_dot_v - 2.64) + 1.58);
    const float t3 = 0.3*t2 + 1.13 - 1.46*n_dot_v;
    const float t4 = 0.42*t0 + 1.028;
    const float t5 = t3*max(roughness, t4) + (n_dot_v - 0.16*t1 + 0.376*t4);
    const float bias = t5*(t5 - 2.104) + 1.1086;
    const float t6 = saturate(n_dot_v*(0.074 - 0.12*roughness) + 1.0015 - 0.016*roughness);
    const float t7 = t6*(0.9*(n_dot_v - 0.5*roughness) - 84.0) + 83.072;
    const float t8 = saturate(n_dot_v*t2 + 0.997) - 0.0804*roughness;
    const float scale = t7*(bias + (0.122*t3 - 0.0359)) + t8;
    return float2(scale, bias);
}
