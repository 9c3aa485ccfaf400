// f0, roughness, n_dot_v → albedo
// data: dielectric_albedo (231dd94cc3ec71a3), seed 1, lgp 0.1.0
// domain: f0 in [0.0125, 0.25], roughness in [0, 1], n_dot_v in [0, 1]
// cost: 46 cycles, 8 registers on gcn
// error: RMSE 0.00331 ± 0.00017, max 0.09550 + 0.00955 over the domain
// finite: albedo finite open in 9.38 % of the domain
// range: albedo ≥ 0 open in 9.38 % of the domain
// energy: albedo ≤ 1 open in 100.00 % of the domain
// formula: t0 = f0*n_dot_v; t1 = 0.7 - 2*t0; t2 = n_dot_v + (roughness*(0.07*(f0 + n_dot_v) - 1.895) + 0.002); t3 = roughness + (roughness*(n_dot_v*t1 - 0.7) + 0.56)*t2; t4 = f0 + (n_dot_v*(f0*(7.3 - 3.7*(min(n_dot_v, t3 + n_dot_v*(0.08*n_dot_v + 0.377)) + (t2 + 20*(t3 - 3*f0))*(0.034 - 0.02*t1))) + 0.026) + 0.022); t5 = t4 + t3*(0.14*t3 - 0.05); t6 = t3*t5; t7 = t6 - 0.67*t0; t8 = log2(abs(t7)); t9 = 0.877*t3 - 0.375; t10 = n_dot_v*(0.3026*t4 - 0.2422) - 0.26035*t8; albedo = saturate((n_dot_v*(t9 + t8*(0.0526*abs(t9) - 0.06886)) + (t6 - 0.056*t4) + t8*(0.00995*t5 + 0.02397))*(t10 - t7*t10 - 0.0835 - 0.05806*(roughness + 1.878*t4)) + (-0.189*t8 - 0.4756 + 0.48*f0 + 0.78863*t6))
float dielectric_albedo(float f0, float roughness, float n_dot_v) {
    const float t0 = f0*n_dot_v;
    const float t1 = 0.7 - 2.0*t0;
    const float t2 = n_dot_v + (roughness*(0.07*(f0 + n_dot_v) - 1.895) + 0.002);
    const float t3 = roughness + (roughness*(n_dot_v*t1 - 0.7) + 0.56)*t2;
    const float t4 = min(n_dot_v, t3 + n_dot_v*(0.08*n_dot_v + 0.377));
    const float t5 = f0*(7.3 - 3.7*(t4 + (t2 + 20.0*(t3 - 3.0*f0))*(0.034 - 0.02*t1)));
    const float t6 = f0 + (n_dot_v*(t5 + 0.026) + 0.022);
    const float t7 = t6 + t3*(0.14*t3 - 0.05);
    const float t8 = t3*t7;
    const float t9 = t8 - 0.67*t0;
    const float t10 = log2(abs(t9));
    const float t11 = 0.877*t3 - 0.375;
    const float t12 = n_dot_v*(0.3026*t6 - 0.2422) - 0.26035*t10;
    const float t13 = n_dot_v*(t11 + t10*(0.0526*abs(t11) - 0.06886)) + (t8 - 0.056*t6);
    const float t14 = t12 - t9*t12 - 0.0835 - 0.05806*(roughness + 1.878*t6);
    const float t15 = -0.189*t10 - 0.4756 + 0.48*f0 + 0.78863*t8;
    const float albedo = saturate((t13 + t10*(0.00995*t7 + 0.02397))*t14 + t15);
    return albedo;
}
