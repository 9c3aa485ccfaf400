// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 9 cycles on gcn
// error: RMSE 0.02138, max 0.11761 on the search split
//        RMSE 0.02135, max 0.14168 on the validation split
//        scale: RMSE 0.02596, max 0.11761
//        bias: RMSE 0.01550, max 0.08746
// finite on every sample of both splits
// t0 = 0.94 - 0.62*n_dot_v; t1 = (max(n_dot_v, roughness) + 1.7*n_dot_v)*t0 - 0.988; scale = min((0.825 - 1.37*roughness)*(n_dot_v + t0*t1) + 0.781, 0.985); bias = t1^2 + 0.004
vec2 dfg(float n_dot_v, float roughness) {
    float t0 = 0.94 - 0.62*n_dot_v;
    float t1 = (max(n_dot_v, roughness) + 1.7*n_dot_v)*t0 - 0.988;
    float scale = min((0.825 - 1.37*roughness)*(n_dot_v + t0*t1) + 0.781, 0.985);
    float bias = t1*t1 + 0.004;
    return vec2(scale, bias);
}
