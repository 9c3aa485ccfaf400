// roughness → average
// data: average_albedo (f7f9202464abc442), seed 1, lgp 0.1.0
// domain: roughness in [0, 1]
// cost: 8 cycles, 2 registers on gcn
// error: RMSE 2.7e-6 ± 6.4e-9, max 1.6e-5 + 0 over the domain
// finite: proved
// range: proved
// energy: proved
// formula: t0 = roughness^2; average = saturate(roughness*(roughness*(roughness*(roughness*(t0*(t0*(0.69*roughness - 1.6207) + 1.8353) - 0.542) - 1.0599) + 0.113245) - 0.006965) + 1.0001633)
float average_albedo_average(float roughness) {
    const float t0 = roughness*roughness;
    const float t1 = roughness*(t0*(t0*(0.69*roughness - 1.6207) + 1.8353) - 0.542) - 1.0599;
    const float t2 = roughness*(roughness*(roughness*t1 + 0.113245) - 0.006965) + 1.0001633;
    const float average = saturate(t2);
    return average;
}
