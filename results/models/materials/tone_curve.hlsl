// stops → display
// data: tone_curve (15bc3817975c703c), seed 1, lgp 0.1.0
// domain: stops in [-6.5, 6.5]
// cost: 14 cycles, 4 registers on gcn
// error: RMSE 0.00011 ± 2.4e-8, max 0.00044 + 0 over the domain
// finite: proved
// range: proved
// formula: t0 = saturate(stops*(0.379 - 0.27*saturate(0.49*stops + 0.18)) + 0.674); t1 = saturate(stops*(0.0087*stops + 0.1587) + 0.734); t2 = stops*(t0^2*(0.0945 - 0.01441*stops) + 0.2269) + 1.75696; display = saturate((t1*(0.36*stops - 1.9853) + t2)*(t1 - 0.23445*t2 + 0.037491*t0))
float tone_curve_display(float stops) {
    const float t0 = saturate(stops*(0.379 - 0.27*saturate(0.49*stops + 0.18)) + 0.674);
    const float t1 = saturate(stops*(0.0087*stops + 0.1587) + 0.734);
    const float t2 = stops*(t0*t0*(0.0945 - 0.01441*stops) + 0.2269) + 1.75696;
    const float t3 = (t1*(0.36*stops - 1.9853) + t2)*(t1 - 0.23445*t2 + 0.037491*t0);
    const float display = saturate(t3);
    return display;
}
