// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 29 cycles on gcn
// error: RMSE 0.00492, max 0.08449 on the search split
//        RMSE 0.00493, max 0.08620 on the validation split
//        scale: RMSE 0.00555, max 0.03029
//        bias: RMSE 0.00420, max 0.08449
// finite on every sample of both splits
// t0 = n_dot_v + 0.05; t1 = 0.757*(roughness + 0.51*n_dot_v); bias = exp2((-6.3*n_dot_v - 5.7)*max(t0, t1) - t1 + 0.258); scale = min(0.7569 - (exp2(max(roughness - 1.6*n_dot_v, 0.12)*(roughness - 3.72) - t0*(12.38 - n_dot_v)) - 0.0611)*((roughness - 0.74)*(-3.16*roughness - 4.94 - 14.7*min(n_dot_v, t1)) - 1.831), 0.9942)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = n_dot_v + 0.05;
    const float t1 = 0.757*(roughness + 0.51*n_dot_v);
    const float bias = exp2((-6.3*n_dot_v - 5.7)*max(t0, t1) - t1 + 0.258);
    const float t2 = max(roughness - 1.6*n_dot_v, 0.12)*(roughness - 3.72);
    const float t3 = (roughness - 0.74)*(-3.16*roughness - 4.94 - 14.7*min(n_dot_v, t1));
    const float t4 = 0.7569 - (exp2(t2 - t0*(12.38 - n_dot_v)) - 0.0611)*(t3 - 1.831);
    const float scale = min(t4, 0.9942);
    return float2(scale, bias);
}
