// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 20 cycles on gcn
// error: RMSE 0.00598, max 0.06006 on the search split
//        RMSE 0.00605, max 0.10265 on the validation split
//        scale: RMSE 0.00715, max 0.03615
//        bias: RMSE 0.00451, max 0.06006
// finite on every sample of both splits
// t0 = n_dot_v + 1.1; t1 = (n_dot_v - 0.33*roughness)*(1.76 - 0.5*t0) - 1.57; t2 = roughness*t1; t3 = t2 + 0.49; t4 = saturate(n_dot_v - 0.69*(t2 + 0.1) + (0.52*t3 + 0.645 - 0.37*t0)*max(roughness, 2.62*t1 + 4.196)); bias = t4*(t4 - 1.977) + 0.9783; scale = bias*(2.35 - 3.3*(saturate(t0 - 0.56*roughness) + 0.18*roughness)) + (saturate(n_dot_v*t3 + 0.952) - 0.051*roughness)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = n_dot_v + 1.1;
    const float t1 = (n_dot_v - 0.33*roughness)*(1.76 - 0.5*t0) - 1.57;
    const float t2 = roughness*t1;
    const float t3 = t2 + 0.49;
    const float t4 = (0.52*t3 + 0.645 - 0.37*t0)*max(roughness, 2.62*t1 + 4.196);
    const float t5 = saturate(n_dot_v - 0.69*(t2 + 0.1) + t4);
    const float bias = t5*(t5 - 1.977) + 0.9783;
    const float t6 = bias*(2.35 - 3.3*(saturate(t0 - 0.56*roughness) + 0.18*roughness));
    const float scale = t6 + (saturate(n_dot_v*t3 + 0.952) - 0.051*roughness);
    return float2(scale, bias);
}
