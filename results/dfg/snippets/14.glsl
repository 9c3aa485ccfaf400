// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 13 cycles on gcn
// error: RMSE 0.00901, max 0.07566 on the search split
//        RMSE 0.00905, max 0.07941 on the validation split
//        scale: RMSE 0.01092, max 0.04954
//        bias: RMSE 0.00656, max 0.07566
// finite on every sample of both splits
// t0 = n_dot_v*(0.67 - 0.45*n_dot_v) - 0.85; t1 = roughness*t0 + 1.9; t2 = saturate(t1 + 0.97*t0); t3 = saturate(t2 - 1.57*n_dot_v); bias = t3*(t3*(t1*t3 - t3) + 0.07) + 0.0036; scale = saturate(n_dot_v*(roughness*(0.66*n_dot_v + (t2 - 2.35)) + 0.35) + 0.939) - 0.995*abs(bias)
vec2 dfg(float n_dot_v, float roughness) {
    float t0 = n_dot_v*(0.67 - 0.45*n_dot_v) - 0.85;
    float t1 = roughness*t0 + 1.9;
    float t2 = clamp(t1 + 0.97*t0, 0.0, 1.0);
    float t3 = clamp(t2 - 1.57*n_dot_v, 0.0, 1.0);
    float bias = t3*(t3*(t1*t3 - t3) + 0.07) + 0.0036;
    float t4 = n_dot_v*(roughness*(0.66*n_dot_v + (t2 - 2.35)) + 0.35) + 0.939;
    float scale = clamp(t4, 0.0, 1.0) - 0.995*abs(bias);
    return vec2(scale, bias);
}
