// n_dot_v, roughness → zh0, zh1, zh2, beta
// data: disney_zh (23644d9a56adc1e7), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 17 cycles, 4 registers on gcn
// error: RMSE 0.00062 ± 2.2e-9, max 0.00631 + 0 over the domain
//        zh0: RMSE 0.00060, max 0.00520
//        zh1: RMSE 0.00069, max 0.00561
//        zh2: RMSE 0.00062, max 0.00597
//        beta: RMSE 0.00056, max 0.00631
// finite: proved
// range: proved
// formula: t0 = n_dot_v*(0.46*n_dot_v - 1.73) + 2.385; t1 = n_dot_v*(n_dot_v*t0 - 1.438) + 0.33; t2 = roughness*t1; t3 = t0*t1; t4 = t2 - 0.1988*t3; zh1 = 1.072*t4 + 0.3242; t5 = t4 + roughness*(0.05*t3 - 0.032); zh2 = 0.55*t5 + 0.16444; beta = t2 + roughness*(t4*(-4.5*(t1 - 0.556*t2) - 0.089) + 0.02459); zh0 = 1.2024*(t4 - 0.2316*t5) + 0.27705
float4 disney_zh(float n_dot_v, float roughness) {
    const float t0 = n_dot_v*(0.46*n_dot_v - 1.73) + 2.385;
    const float t1 = n_dot_v*(n_dot_v*t0 - 1.438) + 0.33;
    const float t2 = roughness*t1;
    const float t3 = t0*t1;
    const float t4 = t2 - 0.1988*t3;
    const float zh1 = 1.072*t4 + 0.3242;
    const float t5 = t4 + roughness*(0.05*t3 - 0.032);
    const float zh2 = 0.55*t5 + 0.16444;
    const float beta = t2 + roughness*(t4*(-4.5*(t1 - 0.556*t2) - 0.089) + 0.02459);
    const float zh0 = 1.2024*(t4 - 0.2316*t5) + 0.27705;
    return float4(zh0, zh1, zh2, beta);
}
