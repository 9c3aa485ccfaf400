// n_dot_v, roughness → zh0, zh1, zh2, beta
// data: disney_zh (23644d9a56adc1e7), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 17 cycles, 4 registers on gcn
// error: RMSE 0.00054, max 0.00540 on the search split
//        RMSE 0.00054, max 0.00637 on the validation split
//        zh0: RMSE 0.00051, max 0.00419
//        zh1: RMSE 0.00052, max 0.00363
//        zh2: RMSE 0.00056, max 0.00476
//        beta: RMSE 0.00055, max 0.00540
// finite: proved
// range: proved
// formula: t0 = n_dot_v*(n_dot_v*(n_dot_v*(0.55*n_dot_v - 1.91) + 2.5) - 1.463) + 0.3306; t1 = abs(t0)*roughness; t2 = t1 + t0*(0.27*n_dot_v - 0.47); t3 = t2 + roughness*(0.114*t0 - 0.0321); zh2 = 0.5522*t3 + 0.1645; beta = t1 + roughness*(t2*(4.46*(0.561*t1 - t0) - 0.0996) + 0.02511); zh0 = 1.2237*(t2 - 0.2423*t3) + 0.27716; zh1 = saturate(1.076*t2 + 0.32454)
float4 disney_zh(float n_dot_v, float roughness) {
    const float t0 = n_dot_v*(n_dot_v*(n_dot_v*(0.55*n_dot_v - 1.91) + 2.5) - 1.463) + 0.3306;
    const float t1 = abs(t0)*roughness;
    const float t2 = t1 + t0*(0.27*n_dot_v - 0.47);
    const float t3 = t2 + roughness*(0.114*t0 - 0.0321);
    const float zh2 = 0.5522*t3 + 0.1645;
    const float beta = t1 + roughness*(t2*(4.46*(0.561*t1 - t0) - 0.0996) + 0.02511);
    const float zh0 = 1.2237*(t2 - 0.2423*t3) + 0.27716;
    const float zh1 = saturate(1.076*t2 + 0.32454);
    return float4(zh0, zh1, zh2, beta);
}
