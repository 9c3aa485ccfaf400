// roughness, n_dot_v → albedo
// data: sheen_volume_albedo (2fdf3d0ef860f024), seed 1, lgp 0.1.0
// domain: roughness in [0.25, 1], n_dot_v in [0, 1]
// cost: 13 cycles, 4 registers on gcn
// error: RMSE 0.00366 ± 2.4e-6, max 0.02774 + 0 over the domain
// finite: proved
// range: proved
// energy: proved
// formula: t0 = roughness*n_dot_v; t1 = roughness*(4.27 - 1.6*roughness); albedo = saturate((-6.19 - (17.6*n_dot_v - 20.8 - 13*t0)*(n_dot_v - 0.8*t0))*(n_dot_v + t0*(t1 - 3.652) - 0.1134) + 0.086 + 0.41*roughness - 0.1651*t1)
float sheen_volume_albedo(float roughness, float n_dot_v) {
    const float t0 = roughness*n_dot_v;
    const float t1 = roughness*(4.27 - 1.6*roughness);
    const float t2 = -6.19 - (17.6*n_dot_v - 20.8 - 13.0*t0)*(n_dot_v - 0.8*t0);
    const float t3 = t2*(n_dot_v + t0*(t1 - 3.652) - 0.1134) + 0.086 + 0.41*roughness;
    const float albedo = saturate(t3 - 0.1651*t1);
    return albedo;
}
