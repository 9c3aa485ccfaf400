// roughness, distance → fitted_roughness
// data: lobe_plane (86c7679baffc374d), seed 1, lgp 0.1.0
// domain: roughness in [0, 1], distance in [0.25, 4]
// cost: 6 cycles, 2 registers on gcn
// error: RMSE 0.00597, max 0.02415 on the search split
//        RMSE 0.00597, max 0.02509 on the validation split
// finite: proved
// range: proved
// formula: t0 = distance*(distance*(distance*(0.015*roughness + 0.01) - 0.137) + 0.67) + 0.452; fitted_roughness = saturate(roughness*t0 - 0.038 + 0.036*t0)
// names: distance_ = distance
float lobe_plane_fitted_roughness(float roughness, float distance_) {
    const float t0 = distance_*(distance_*(0.015*roughness + 0.01) - 0.137) + 0.67;
    const float t1 = distance_*t0 + 0.452;
    const float fitted_roughness = saturate(roughness*t1 - 0.038 + 0.036*t1);
    return fitted_roughness;
}
