// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 30 cycles on gcn
// error: RMSE 0.00400, max 0.06713 on the search split
//        RMSE 0.00405, max 0.08686 on the validation split
//        scale: RMSE 0.00430, max 0.03157
//        bias: RMSE 0.00367, max 0.06713
// finite on every sample of both splits
// t0 = saturate(n_dot_v*(1.34 - 2.1*roughness) + 1.035 - 0.32*roughness) - 0.1*n_dot_v; t1 = 0.08 - n_dot_v*roughness; t2 = 1.24*n_dot_v - 1.88; t3 = roughness*t2 + 0.1833; t4 = t3 + n_dot_v*saturate(n_dot_v*(0.636*n_dot_v - 1.8517) + 1.30865); t5 = 0.6486*t2 + 1.27815; t6 = (0.3386*t4 + 1.06247 - 1.554*n_dot_v)*max(roughness, t5) + (n_dot_v - 0.2081*t3 + 0.4488*t5); t7 = (t6 - 2.07367)*(t6 + 0.02464*n_dot_v) + 1.09734; scale = saturate((4.50282 - 5.5*(t0 + 0.113*roughness))*(t7 + 0.06435*t1) + (saturate(n_dot_v*t4 + 0.9941) + roughness*(1.6*saturate(0.137*n_dot_v + (roughness*t1 - 0.03)) - 0.122))); bias = t0*t7
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = saturate(n_dot_v*(1.34 - 2.1*roughness) + 1.035 - 0.32*roughness);
    const float t1 = t0 - 0.1*n_dot_v;
    const float t2 = 0.08 - n_dot_v*roughness;
    const float t3 = 1.24*n_dot_v - 1.88;
    const float t4 = roughness*t3 + 0.1833;
    const float t5 = t4 + n_dot_v*saturate(n_dot_v*(0.636*n_dot_v - 1.8517) + 1.30865);
    const float t6 = 0.6486*t3 + 1.27815;
    const float t7 = (0.3386*t5 + 1.06247 - 1.554*n_dot_v)*max(roughness, t6);
    const float t8 = t7 + (n_dot_v - 0.2081*t4 + 0.4488*t6);
    const float t9 = (t8 - 2.07367)*(t8 + 0.02464*n_dot_v) + 1.09734;
    const float t10 = roughness*(1.6*saturate(0.137*n_dot_v + (roughness*t2 - 0.03)) - 0.122);
    const float t11 = (4.50282 - 5.5*(t1 + 0.113*roughness))*(t9 + 0.06435*t2);
    const float scale = saturate(t11 + (saturate(n_dot_v*t5 + 0.9941) + t10));
    const float bias = t1*t9;
    return float2(scale, bias);
}
