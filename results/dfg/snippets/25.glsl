// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 24 cycles on gcn
// error: RMSE 0.00512, max 0.04708 on the search split
//        RMSE 0.00519, max 0.09752 on the validation split
//        scale: RMSE 0.00591, max 0.04537
//        bias: RMSE 0.00420, max 0.04708
// finite on every sample of both splits
// t0 = saturate(saturate(roughness*(-n_dot_v - 0.76) + 1.022 + 1.51*n_dot_v) - 1.1*n_dot_v); t1 = n_dot_v*roughness; t2 = t1*(1.65*roughness - 2.61) - (roughness*(1.067*roughness - 1.849) + 0.993 - 1.313*n_dot_v); t3 = 0.01595*((t1*(30*roughness + 34) + 1.25)*(roughness - 0.4145*n_dot_v)) - 0.0139; t4 = saturate(t3 + 0.02734*n_dot_v); bias = saturate(t0*(t0 + 3.4*roughness)*(t2^2 + 0.0065)); scale = t4*(t4 - 1.7214) + 0.99778 + bias*(-22.01*t3 - 1.3175)
vec2 dfg(float n_dot_v, float roughness) {
    float t0 = clamp(roughness*(-n_dot_v - 0.76) + 1.022 + 1.51*n_dot_v, 0.0, 1.0);
    float t1 = clamp(t0 - 1.1*n_dot_v, 0.0, 1.0);
    float t2 = n_dot_v*roughness;
    float t3 = roughness*(1.067*roughness - 1.849) + 0.993 - 1.313*n_dot_v;
    float t4 = t2*(1.65*roughness - 2.61) - t3;
    float t5 = (t2*(30.0*roughness + 34.0) + 1.25)*(roughness - 0.4145*n_dot_v);
    float t6 = 0.01595*t5 - 0.0139;
    float t7 = clamp(t6 + 0.02734*n_dot_v, 0.0, 1.0);
    float bias = clamp(t1*(t1 + 3.4*roughness)*(t4*t4 + 0.0065), 0.0, 1.0);
    float scale = t7*(t7 - 1.7214) + 0.99778 + bias*(-22.01*t6 - 1.3175);
    return vec2(scale, bias);
}
