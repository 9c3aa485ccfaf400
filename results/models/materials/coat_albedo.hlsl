// roughness, n_dot_v → albedo
// data: coat_albedo (81a68479af8c5d0c), seed 1, lgp 0.1.0
// domain: roughness in [0, 1], n_dot_v in [0, 1]
// cost: 12 cycles, 4 registers on gcn
// error: RMSE 0.00246, max 0.04578 on the search split
//        RMSE 0.00253, max 0.10003 on the validation split
// finite: proved
// range: proved
// energy: proved
// formula: t0 = n_dot_v + 0.037; t1 = max(roughness, t0); t2 = t1*(1.68*t1 - 3.55) + 2.35; t3 = ((t0 - 0.4*roughness)*(1.05 - 0.44*n_dot_v) - 0.39)*t2 - 0.203; albedo = saturate(t3*(t2*(roughness - 0.743*n_dot_v) + t3) + 0.0255 - 0.0275*t0)
float coat_albedo(float roughness, float n_dot_v) {
    const float t0 = n_dot_v + 0.037;
    const float t1 = max(roughness, t0);
    const float t2 = t1*(1.68*t1 - 3.55) + 2.35;
    const float t3 = ((t0 - 0.4*roughness)*(1.05 - 0.44*n_dot_v) - 0.39)*t2 - 0.203;
    const float albedo = saturate(t3*(t2*(roughness - 0.743*n_dot_v) + t3) + 0.0255 - 0.0275*t0);
    return albedo;
}
