// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 22 cycles on gcn
// error: RMSE 0.00568, max 0.05105 on the search split
//        RMSE 0.00578, max 0.11949 on the validation split
//        scale: RMSE 0.00686, max 0.03422
//        bias: RMSE 0.00418, max 0.05105
// finite on every sample of both splits
// t0 = n_dot_v + 1.09; t1 = (n_dot_v - 0.66*roughness)*(1.57 - 0.5*t0) - 1.2; t2 = roughness*t1; t3 = t2 + 0.42; t4 = saturate(n_dot_v - 0.81*(t2 + 0.04) + (0.617*t3 + 0.57 - 0.33*t0)*max(roughness, 3.22*(t1 - 0.306*t3) + 4.342)); bias = (t4 - 2.014)*(t4 + 0.013*n_dot_v) + 1.0257; scale = bias*(2.622 - 3.56*(saturate(t0 - 0.53*roughness) + 0.155*roughness)) + (saturate(n_dot_v*t3 + 0.942) - 0.0492*roughness)
vec2 dfg(float n_dot_v, float roughness) {
    float t0 = n_dot_v + 1.09;
    float t1 = (n_dot_v - 0.66*roughness)*(1.57 - 0.5*t0) - 1.2;
    float t2 = roughness*t1;
    float t3 = t2 + 0.42;
    float t4 = (0.617*t3 + 0.57 - 0.33*t0)*max(roughness, 3.22*(t1 - 0.306*t3) + 4.342);
    float t5 = clamp(n_dot_v - 0.81*(t2 + 0.04) + t4, 0.0, 1.0);
    float bias = (t5 - 2.014)*(t5 + 0.013*n_dot_v) + 1.0257;
    float t6 = 2.622 - 3.56*(clamp(t0 - 0.53*roughness, 0.0, 1.0) + 0.155*roughness);
    float scale = bias*t6 + (clamp(n_dot_v*t3 + 0.942, 0.0, 1.0) - 0.0492*roughness);
    return vec2(scale, bias);
}
