// eta → outer, inner
// data: average_fresnel (786255bdf3f60f9d), seed 1, lgp 0.1.0
// domain: eta in [1, 3]
// cost: 12 cycles, 4 registers on gcn
// error: RMSE 6.1e-5 ± 5.0e-8, max 0.00067 + 0 over the domain
//        outer: RMSE 5.0e-5, max 0.00026
//        inner: RMSE 7.0e-5, max 0.00067
// finite: proved
// range: proved
// formula: t0 = eta - 0.486; t1 = sqrt(t0); inner = (-1.73*eta - 1.4939)/t1 + (0.31887*eta + 4.17856); outer = (inner*(-0.06456*inner - 0.0034) - 0.08131 + 0.28823*t0)/t1 - 0.09296972
float2 average_fresnel(float eta) {
    const float t0 = eta - 0.486;
    const float t1 = sqrt(t0);
    const float inner = (-1.73*eta - 1.4939)/t1 + (0.31887*eta + 4.17856);
    const float outer = (inner*(-0.06456*inner - 0.0034) - 0.08131 + 0.28823*t0)/t1 - 0.09296972;
    return float2(outer, inner);
}
