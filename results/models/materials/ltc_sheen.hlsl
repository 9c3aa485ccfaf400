// roughness, n_dot_v → m11, m13, albedo
// data: ltc_sheen (90c06d7e4b30fb79), seed 1, lgp 0.1.0
// domain: roughness in [0.25, 1], n_dot_v in [0, 1]
// cost: 14 cycles, 5 registers on gcn
// error: RMSE 0.01322, max 0.07944 on the search split
//        RMSE 0.01337, max 0.09057 on the validation split
//        m11: RMSE 0.01276, max 0.07373
//        m13: RMSE 0.01042, max 0.07250
//        albedo: RMSE 0.01590, max 0.07944
// finite: proved
// range: proved
// energy: proved
// formula: m13 = saturate(roughness - 0.7*n_dot_v - 0.15)*(0.94*roughness - 0.88) - 0.032; t0 = n_dot_v*(2.3*roughness - 1.16); t1 = n_dot_v*(n_dot_v*(4.7 - 1.8*n_dot_v) - 4.67) + 1.024; m11 = roughness*(t1*(0.58*roughness - 0.635) + 0.854); albedo = saturate(t0 + 0.297 + (t0 + 0.4)*t1)
float3 ltc_sheen(float roughness, float n_dot_v) {
    const float m13 = saturate(roughness - 0.7*n_dot_v - 0.15)*(0.94*roughness - 0.88) - 0.032;
    const float t0 = n_dot_v*(2.3*roughness - 1.16);
    const float t1 = n_dot_v*(n_dot_v*(4.7 - 1.8*n_dot_v) - 4.67) + 1.024;
    const float m11 = roughness*(t1*(0.58*roughness - 0.635) + 0.854);
    const float albedo = saturate(t0 + 0.297 + (t0 + 0.4)*t1);
    return float3(m11, m13, albedo);
}
