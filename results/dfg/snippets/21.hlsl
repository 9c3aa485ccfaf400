// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 21 cycles on gcn
// error: RMSE 0.00576, max 0.04495 on the search split
//        RMSE 0.00582, max 0.06721 on the validation split
//        scale: RMSE 0.00654, max 0.03768
//        bias: RMSE 0.00485, max 0.04495
// finite on every sample of both splits
// t0 = 0.08 - 0.28*n_dot_v; t1 = -0.6*n_dot_v; t2 = max(n_dot_v, roughness) + t1; bias = exp2(t2*(-1.08 - (13 - 10.3*t2)*(roughness + t1)) - (n_dot_v*(8.36 - 27.5*t0) + 0.036)); t3 = roughness + t0; t4 = n_dot_v*(t3^2 - 0.047); t5 = 0.907 - 0.89*t4; scale = t5*(min(t5, 0.886) - bias*(18.6*t4 + 1.145)) + 0.1696
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = 0.08 - 0.28*n_dot_v;
    const float t1 = -0.6*n_dot_v;
    const float t2 = max(n_dot_v, roughness) + t1;
    const float t3 = t2*(-1.08 - (13.0 - 10.3*t2)*(roughness + t1));
    const float bias = exp2(t3 - (n_dot_v*(8.36 - 27.5*t0) + 0.036));
    const float t4 = roughness + t0;
    const float t5 = n_dot_v*(t4*t4 - 0.047);
    const float t6 = 0.907 - 0.89*t5;
    const float scale = t6*(min(t6, 0.886) - bias*(18.6*t5 + 1.145)) + 0.1696;
    return float2(scale, bias);
}
