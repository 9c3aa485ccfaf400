// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 6 cycles on gcn
// error: RMSE 0.02833, max 0.16504 on the search split
//        RMSE 0.02827, max 0.16502 on the validation split
//        scale: RMSE 0.03194, max 0.15116
//        bias: RMSE 0.02419, max 0.16504
// finite on every sample of both splits
// t0 = saturate(saturate(2.1 - 2*roughness) - 2.4*n_dot_v); t1 = 0.83 - 1.37*roughness; scale = saturate(t1*(n_dot_v - 0.78*t0) + 0.77); bias = t0*abs(t1) + 0.01
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = saturate(saturate(2.1 - 2.0*roughness) - 2.4*n_dot_v);
    const float t1 = 0.83 - 1.37*roughness;
    const float scale = saturate(t1*(n_dot_v - 0.78*t0) + 0.77);
    const float bias = t0*abs(t1) + 0.01;
    return float2(scale, bias);
}
