// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 11 cycles on gcn
// error: RMSE 0.01177, max 0.09794 on the search split
//        RMSE 0.01180, max 0.10514 on the validation split
//        scale: RMSE 0.01424, max 0.09794
//        bias: RMSE 0.00861, max 0.05220
// finite on every sample of both splits
// t0 = n_dot_v*(0.03*n_dot_v - 0.065) + 0.036; t1 = -34*(t0*max(n_dot_v, roughness)); t2 = saturate(t1 + 0.9899 - 1.393*n_dot_v); bias = t0 + t2^2; scale = saturate(n_dot_v*(t1 + 0.6403 - 1.26*roughness) + 0.9503) - 1.04*bias
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = n_dot_v*(0.03*n_dot_v - 0.065) + 0.036;
    const float t1 = -34.0*(t0*max(n_dot_v, roughness));
    const float t2 = saturate(t1 + 0.9899 - 1.393*n_dot_v);
    const float bias = t0 + t2*t2;
    const float scale = saturate(n_dot_v*(t1 + 0.6403 - 1.26*roughness) + 0.9503) - 1.04*bias;
    return float2(scale, bias);
}
