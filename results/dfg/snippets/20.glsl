// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 19 cycles on gcn
// error: RMSE 0.00664, max 0.06383 on the search split
//        RMSE 0.00672, max 0.09253 on the validation split
//        scale: RMSE 0.00802, max 0.04898
//        bias: RMSE 0.00490, max 0.06383
// finite on every sample of both splits
// t0 = n_dot_v + 1.16; t1 = (n_dot_v - 0.4*roughness)*(1.42 - 0.4*t0) - 1.44; t2 = roughness*t1; t3 = t2 + 0.55; t4 = saturate(n_dot_v - 0.73*(t2 + 0.08) + (0.54*t3 + 0.61 - 0.36*t0)*max(roughness, 3.18*t1 + 4.701)); bias = t4*(t4 - 1.997) + 0.9989; scale = bias*(2.644 - 3.6*saturate(t0 - 0.67*roughness)) + (saturate(n_dot_v*t3 + 0.905) - 0.0527*roughness)
vec2 dfg(float n_dot_v, float roughness) {
    float t0 = n_dot_v + 1.16;
    float t1 = (n_dot_v - 0.4*roughness)*(1.42 - 0.4*t0) - 1.44;
    float t2 = roughness*t1;
    float t3 = t2 + 0.55;
    float t4 = (0.54*t3 + 0.61 - 0.36*t0)*max(roughness, 3.18*t1 + 4.701);
    float t5 = clamp(n_dot_v - 0.73*(t2 + 0.08) + t4, 0.0, 1.0);
    float bias = t5*(t5 - 1.997) + 0.9989;
    float t6 = bias*(2.644 - 3.6*clamp(t0 - 0.67*roughness, 0.0, 1.0));
    float scale = t6 + (clamp(n_dot_v*t3 + 0.905, 0.0, 1.0) - 0.0527*roughness);
    return vec2(scale, bias);
}
