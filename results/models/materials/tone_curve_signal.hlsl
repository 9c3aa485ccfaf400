// stops → signal
// data: tone_curve_signal (46ba5a4ab609dc0b), seed 1, lgp 0.1.0
// domain: stops in [-6.5, 6.5]
// cost: 11 cycles, 5 registers on gcn
// error: RMSE 0.00026 ± 7.7e-8, max 0.00098 + 9.1e-7 over the domain
// finite: proved
// range: proved
// formula: t0 = abs(stops); t1 = saturate(stops*(0.279 - 0.03*t0) + 0.665); t2 = t0 - 1.3; signal = saturate(t1*saturate(1.0087 - (t0*(0.0724 - 0.011*t2) - 0.3274)*(stops - 3.14*t1 + t2*(-0.04364*stops - 0.4109))) + 0.02337 + 0.003886*stops)
float tone_curve_signal(float stops) {
    const float t0 = abs(stops);
    const float t1 = saturate(stops*(0.279 - 0.03*t0) + 0.665);
    const float t2 = t0 - 1.3;
    const float t3 = stops - 3.14*t1 + t2*(-0.04364*stops - 0.4109);
    const float t4 = t1*saturate(1.0087 - (t0*(0.0724 - 0.011*t2) - 0.3274)*t3) + 0.02337;
    const float signal = saturate(t4 + 0.003886*stops);
    return signal;
}
