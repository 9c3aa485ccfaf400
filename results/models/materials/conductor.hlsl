// wavelength → n, k
// data: conductor (770edc1bae551658), seed 1, lgp 0.1.0
// domain: wavelength in [0.38, 0.78]
// cost: 20 cycles, 5 registers on gcn
// error: RMSE 0.00081 ± 5.9e-7, max 0.00444 + 0 over the domain
//        n: RMSE 0.00082, max 0.00312
//        k: RMSE 0.00079, max 0.00444
// finite: proved
// range: proved
// formula: t0 = 31.1*wavelength^2 - 16; t1 = wavelength*t0; t2 = saturate(t1 + 4.477); t3 = wavelength*(wavelength*(-35*t2 - 58) + (0.0155*(t0*(t1 + 20)) + 143.34) + 21.67*t2) - 100.267; t4 = wavelength*t3 + 20.5475; t5 = t2*t4; n = 1.8088*t5 + 1.60956; t6 = 0.03446 - 0.0037*(t4*t5); k = 4.6767*(wavelength + (t3*t6 + (1.54253 - 0.1895*t2))*(t2 - 11.654*t6)) - 0.4858
float2 conductor(float wavelength) {
    const float t0 = 31.1*(wavelength*wavelength) - 16.0;
    const float t1 = wavelength*t0;
    const float t2 = saturate(t1 + 4.477);
    const float t3 = wavelength*(-35.0*t2 - 58.0) + (0.0155*(t0*(t1 + 20.0)) + 143.34);
    const float t4 = wavelength*(t3 + 21.67*t2) - 100.267;
    const float t5 = wavelength*t4 + 20.5475;
    const float t6 = t2*t5;
    const float n = 1.8088*t6 + 1.60956;
    const float t7 = 0.03446 - 0.0037*(t5*t6);
    const float t8 = 4.6767*(wavelength + (t4*t7 + (1.54253 - 0.1895*t2))*(t2 - 11.654*t7));
    const float k = t8 - 0.4858;
    return float2(n, k);
}
