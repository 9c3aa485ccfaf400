// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 28 cycles on gcn
// error: RMSE 0.00530, max 0.08554 on the search split
//        RMSE 0.00533, max 0.09662 on the validation split
//        scale: RMSE 0.00569, max 0.03961
//        bias: RMSE 0.00488, max 0.08554
// finite on every sample of both splits
// t0 = n_dot_v + 0.043; t1 = 0.766*(roughness + 0.53*n_dot_v); bias = exp2((-6*t0 - 6.34)*max(t0, t1) + 0.25); scale = min(0.7569 - 0.3605*((exp2(max(n_dot_v, 0.66*roughness - 0.073)*(roughness - 5.13) - 7.4*n_dot_v) - 0.1205)*((roughness - 0.739)*(-5.16*roughness - 6.66 - 20*min(n_dot_v, t1)) - 2.555)), 0.994)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = n_dot_v + 0.043;
    const float t1 = 0.766*(roughness + 0.53*n_dot_v);
    const float bias = exp2((-6.0*t0 - 6.34)*max(t0, t1) + 0.25);
    const float t2 = max(n_dot_v, 0.66*roughness - 0.073)*(roughness - 5.13) - 7.4*n_dot_v;
    const float t3 = (roughness - 0.739)*(-5.16*roughness - 6.66 - 20.0*min(n_dot_v, t1));
    const float scale = min(0.7569 - 0.3605*((exp2(t2) - 0.1205)*(t3 - 2.555)), 0.994);
    return float2(scale, bias);
}
