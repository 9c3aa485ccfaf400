// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 25 cycles on gcn
// error: RMSE 0.00563, max 0.06318 on the search split
//        RMSE 0.00569, max 0.08369 on the validation split
//        scale: RMSE 0.00660, max 0.03862
//        bias: RMSE 0.00447, max 0.06318
// finite on every sample of both splits
// t0 = roughness - 0.57*n_dot_v; t1 = t0 - 0.05; t2 = t0 + max(n_dot_v, 2.7*t1); bias = exp2(t2*(t1*(0.66*t2 - 2.66) - 0.77) - (n_dot_v*(7*n_dot_v + 6.1) + 0.032)); t3 = roughness + (0.115 - 0.297*n_dot_v); t4 = n_dot_v*(max(t1, t3^2) - 0.059); t5 = 0.9928 - 0.7334*t4; scale = t5*(min(t5, 0.9775) + bias*(-12.99*t4 - 1.0267))
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = roughness - 0.57*n_dot_v;
    const float t1 = t0 - 0.05;
    const float t2 = t0 + max(n_dot_v, 2.7*t1);
    const float t3 = t2*(t1*(0.66*t2 - 2.66) - 0.77) - (n_dot_v*(7.0*n_dot_v + 6.1) + 0.032);
    const float bias = exp2(t3);
    const float t4 = roughness + (0.115 - 0.297*n_dot_v);
    const float t5 = n_dot_v*(max(t1, t4*t4) - 0.059);
    const float t6 = 0.9928 - 0.7334*t5;
    const float scale = t6*(min(t6, 0.9775) + bias*(-12.99*t5 - 1.0267));
    return float2(scale, bias);
}
