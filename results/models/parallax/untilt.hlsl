// fitted_roughness, cosine → roughness
// data: untilt (3c3f5a91c2f185bb), seed 1, lgp 0.1.0
// domain: fitted_roughness in [0.001, 0.9941819], cosine in [0.5, 1]
// cost: 5 cycles, 2 registers on gcn
// error: RMSE 0.01204, max 0.07583 on the search split
//        RMSE 0.01207, max 0.07173 on the validation split
// finite: proved
// range: proved
// formula: roughness = fitted_roughness*saturate(cosine*((0.3*cosine - 0.64)*(fitted_roughness + 26*cosine) + 12.46) - 2.36)
float untilt_roughness(float fitted_roughness, float cosine) {
    const float t0 = cosine*((0.3*cosine - 0.64)*(fitted_roughness + 26.0*cosine) + 12.46);
    const float roughness = fitted_roughness*saturate(t0 - 2.36);
    return roughness;
}
