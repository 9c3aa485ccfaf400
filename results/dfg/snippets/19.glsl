// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 18 cycles on gcn
// error: RMSE 0.00714, max 0.06675 on the search split
//        RMSE 0.00720, max 0.08502 on the validation split
//        scale: RMSE 0.00871, max 0.06675
//        bias: RMSE 0.00510, max 0.06276
// finite on every sample of both splits
// t0 = 0.47*n_dot_v + (-0.2*roughness - 1.4); t1 = roughness*t0; t2 = t1 + 0.604; t3 = saturate(n_dot_v - 0.69*(t1 + 0.1) + (0.57*t2 + 0.3 - 0.57*n_dot_v)*max(roughness, 4.4*t0 + 6.286)); bias = t3*(t3 - 1.995) + 0.995; scale = bias*(7.457 - 8.4*saturate(n_dot_v*roughness + 1.1 - 0.37*roughness)) + (saturate(n_dot_v*t2 + 0.894) - 0.0614*roughness)
vec2 dfg(float n_dot_v, float roughness) {
    float t0 = 0.47*n_dot_v + (-0.2*roughness - 1.4);
    float t1 = roughness*t0;
    float t2 = t1 + 0.604;
    float t3 = (0.57*t2 + 0.3 - 0.57*n_dot_v)*max(roughness, 4.4*t0 + 6.286);
    float t4 = clamp(n_dot_v - 0.69*(t1 + 0.1) + t3, 0.0, 1.0);
    float bias = t4*(t4 - 1.995) + 0.995;
    float t5 = 7.457 - 8.4*clamp(n_dot_v*roughness + 1.1 - 0.37*roughness, 0.0, 1.0);
    float scale = bias*t5 + (clamp(n_dot_v*t2 + 0.894, 0.0, 1.0) - 0.0614*roughness);
    return vec2(scale, bias);
}
