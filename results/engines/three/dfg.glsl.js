// n_dot_v, roughness -> scale, bias
// data: dfg (d9bba53fa1b19ffd), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 14 cycles, 4 registers on gcn
// error: RMSE 0.00899 +- 5.5e-6, max 0.09548 + 0.00038 over the domain
//        scale: RMSE 0.01082, max 0.06990
//        bias: RMSE 0.00669, max 0.09548
// finite: proved
// range: proved
// energy: proved
// formula: t0 = n_dot_v*(5*n_dot_v - 8.6) + 2.45; t1 = n_dot_v*(-0.8*roughness - 0.64) - 0.08; t2 = 0.097*t0 + abs(roughness + 0.256*t1); t3 = max(roughness, n_dot_v + 0.26*t2); t4 = t3*(t3*(0.96 - 0.32*roughness) - 0.967) + 0.3379; bias = saturate(t4 + t0*t4); scale = saturate(saturate(t1*t2 + 1.023) - 1.05*bias)
// names: dotNV = n_dot_v
export const dfg = /* glsl */`
vec2 dfg(float dotNV, float roughness) {
    float t0 = dotNV*(5.0*dotNV - 8.6) + 2.45;
    float t1 = dotNV*(-0.8*roughness - 0.64) - 0.08;
    float t2 = 0.097*t0 + abs(roughness + 0.256*t1);
    float t3 = max(roughness, dotNV + 0.26*t2);
    float t4 = t3*(t3*(0.96 - 0.32*roughness) - 0.967) + 0.3379;
    float bias = clamp(t4 + t0*t4, 0.0, 1.0);
    float scale = clamp(clamp(t1*t2 + 1.023, 0.0, 1.0) - 1.05*bias, 0.0, 1.0);
    return vec2(scale, bias);
}
`;
