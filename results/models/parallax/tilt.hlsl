// roughness, cosine → fitted_roughness
// data: tilt (4422261c5219dab4), seed 1, lgp 0.1.0
// domain: roughness in [0.001, 1], cosine in [0.5, 1]
// cost: 6 cycles, 2 registers on gcn
// error: RMSE 0.00775, max 0.07422 on the search split
//        RMSE 0.00770, max 0.08438 on the validation split
// finite: proved
// range: proved
// formula: fitted_roughness = saturate(roughness + (roughness - roughness*cosine)*(roughness*(roughness*(30*roughness - 17) + 3.1) + 2.8 - 2.93*cosine))
float tilt_fitted_roughness(float roughness, float cosine) {
    const float t0 = roughness*(roughness*(30.0*roughness - 17.0) + 3.1) + 2.8 - 2.93*cosine;
    const float fitted_roughness = saturate(roughness + (roughness - roughness*cosine)*t0);
    return fitted_roughness;
}
