// roughness, n_dot_v → albedo
// data: sheen_albedo_materialx (ef150adc7ead6178), seed 1, lgp 0.1.0
// domain: roughness in [0, 1], n_dot_v in [0, 1]
// cost: 18 cycles, 3 registers on gcn
// error: RMSE 0.00156 ± 5.0e-6, max 0.02602 + 9.0e-5 over the domain
// finite: albedo finite open in 5e-89 % of the domain
// range: albedo ≥ 0 open in 5e-89 % of the domain
// energy: albedo ≤ 1 open in 5e-89 % of the domain
// formula: t0 = rsqrt(abs(roughness + n_dot_v*(3.8*roughness - 0.065))*(5.64 - 4.4*n_dot_v) + (n_dot_v + n_dot_v*(n_dot_v + 5.5*n_dot_v^2))); albedo = saturate(t0*((4.8*roughness + 0.016)*(t0^2 + 0.0193) - 0.1355 - 0.465*n_dot_v) + (0.3045 - 0.1232*max(n_dot_v, 0.199)))
float sheen_albedo_materialx_albedo(float roughness, float n_dot_v) {
    const float t0 = abs(roughness + n_dot_v*(3.8*roughness - 0.065))*(5.64 - 4.4*n_dot_v);
    const float t1 = rsqrt(t0 + (n_dot_v + n_dot_v*(n_dot_v + 5.5*(n_dot_v*n_dot_v))));
    const float t2 = t1*((4.8*roughness + 0.016)*(t1*t1 + 0.0193) - 0.1355 - 0.465*n_dot_v);
    const float albedo = saturate(t2 + (0.3045 - 0.1232*max(n_dot_v, 0.199)));
    return albedo;
}
