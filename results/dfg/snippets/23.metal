// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 22 cycles on gcn
// error: RMSE 0.00517, max 0.04929 on the search split
//        RMSE 0.00523, max 0.07288 on the validation split
//        scale: RMSE 0.00598, max 0.03887
//        bias: RMSE 0.00422, max 0.04929
// finite on every sample of both splits
// t0 = roughness - 0.86*n_dot_v; t1 = roughness - 0.255*n_dot_v; bias = exp2(min(t0*(-0.6 - (11.3 - 9*t0)*t1) + min(n_dot_v, 0.08), -0.04) - n_dot_v*(6.5*n_dot_v + 7.1) - t0); t2 = n_dot_v*(0.02 - t1*max(t1, 0.03)); t3 = 1.1*t2 + 0.87; scale = t3*(min(t3, 0.851) - bias*(1.2 - 29*t2)) + 0.2404
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = roughness - 0.86*n_dot_v;
    const float t1 = roughness - 0.255*n_dot_v;
    const float t2 = min(t0*(-0.6 - (11.3 - 9.0*t0)*t1) + min(n_dot_v, 0.08), -0.04);
    const float bias = exp2(t2 - n_dot_v*(6.5*n_dot_v + 7.1) - t0);
    const float t3 = n_dot_v*(0.02 - t1*max(t1, 0.03));
    const float t4 = 1.1*t3 + 0.87;
    const float scale = t4*(min(t4, 0.851) - bias*(1.2 - 29.0*t3)) + 0.2404;
    return float2(scale, bias);
}
