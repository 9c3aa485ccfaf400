// roughness, n_dot_v → albedo
// data: sheen_albedo (eaf3c8fc91a4f8cf), seed 1, lgp 0.1.0
// domain: roughness in [0, 1], n_dot_v in [0, 1]
// cost: 9 cycles, 2 registers on gcn
// error: RMSE 0.00892 ± 1.5e-5, max 0.37861 + 0.00029 over the domain
// finite: albedo finite refuted: NaN at n_dot_v = 0.0, roughness = 0.0
// range: albedo ≥ 0 refuted: NaN at n_dot_v = 0.0, roughness = 0.0
// energy: albedo ≤ 1 refuted: NaN at n_dot_v = 0.0, roughness = 0.0
// formula: t0 = rsqrt(roughness + 0.73*n_dot_v); t1 = t0^2 + 0.09; albedo = saturate(t1*(n_dot_v*(-0.32*t1 - 0.227) + 0.32) + 0.219)
float sheen_albedo(float roughness, float n_dot_v) {
    const float t0 = rsqrt(roughness + 0.73*n_dot_v);
    const float t1 = t0*t0 + 0.09;
    const float albedo = saturate(t1*(n_dot_v*(-0.32*t1 - 0.227) + 0.32) + 0.219);
    return albedo;
}
