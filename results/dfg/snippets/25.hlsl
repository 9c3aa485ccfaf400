// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 27 cycles on gcn
// error: RMSE 0.00538, max 0.07738 on the search split
//        RMSE 0.00541, max 0.09978 on the validation split
//        scale: RMSE 0.00583, max 0.04148
//        bias: RMSE 0.00489, max 0.07738
// finite on every sample of both splits
// t0 = n_dot_v + 0.04; t1 = 0.764*(roughness + 0.515*n_dot_v); bias = exp2((-6.3*t0 - 6.3)*max(t0, t1) + 0.233); t2 = 0.66*roughness; scale = min(0.7565 - (exp2(max(n_dot_v, t2 - 0.0745)*(t2 - 4.73) - 7.65*n_dot_v) - 0.1227)*((roughness - 0.735)*(-1.62*roughness - 2.342 - 7.3*min(n_dot_v, t1)) - 0.863), 0.99425)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = n_dot_v + 0.04;
    const float t1 = 0.764*(roughness + 0.515*n_dot_v);
    const float bias = exp2((-6.3*t0 - 6.3)*max(t0, t1) + 0.233);
    const float t2 = 0.66*roughness;
    const float t3 = (roughness - 0.735)*(-1.62*roughness - 2.342 - 7.3*min(n_dot_v, t1));
    const float t4 = exp2(max(n_dot_v, t2 - 0.0745)*(t2 - 4.73) - 7.65*n_dot_v) - 0.1227;
    const float scale = min(0.7565 - t4*(t3 - 0.863), 0.99425);
    return float2(scale, bias);
}
