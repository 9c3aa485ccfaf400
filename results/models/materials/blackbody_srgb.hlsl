// temperature → r, g, b
// data: blackbody_srgb (b013c89f8337361f), seed 1, lgp 0.1.0
// domain: temperature in [1000, 15000]
// cost: 23 cycles, 6 registers on gcn
// error: RMSE 0.00029 ± 8.5e-8, max 0.00265 + 0 over the domain
//        r: RMSE 0.00046, max 0.00265
//        g: RMSE 0.00014, max 0.00082
//        b: RMSE 0.00016, max 0.00118
// finite: proved
// range: proved
// formula: t0 = 0.000061035156*temperature; t1 = t0*(t0 + 0.16*t0); t2 = t0*(t0 + t1*(t0*((0.113*t0 - 0.282)*t1 + 0.8515) - 1.26025)); t3 = saturate(t0 - 2.8732*t2); t4 = exp2(3.6151 - 34.38*t3); t5 = t0 - (4.828 - 1.5*t4)*(t2*(t4 + 0.106*t0) + (0.00933 - 0.1855*t3)); b = 5.114*t5 - 0.43876; r = t4 - 1.7362*t5 + 1.10824; g = 1.11305 - 0.29733*t4
float3 blackbody_srgb(float temperature) {
    const float t0 = 0.000061035156*temperature;
    const float t1 = t0*(t0 + 0.16*t0);
    const float t2 = t0*(t0 + t1*(t0*((0.113*t0 - 0.282)*t1 + 0.8515) - 1.26025));
    const float t3 = saturate(t0 - 2.8732*t2);
    const float t4 = exp2(3.6151 - 34.38*t3);
    const float t5 = t0 - (4.828 - 1.5*t4)*(t2*(t4 + 0.106*t0) + (0.00933 - 0.1855*t3));
    const float b = 5.114*t5 - 0.43876;
    const float r = t4 - 1.7362*t5 + 1.10824;
    const float g = 1.11305 - 0.29733*t4;
    return float3(r, g, b);
}
