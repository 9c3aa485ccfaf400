// sin_half_omega, roughness, n_dot_v, n_dot_l, r_dot_l → lobe
// data: sphere_light (91a37a0cf417c858), seed 1, lgp 0.1.0
// domain: sin_half_omega in [0.01, 0.48], roughness in [0.1, 1], n_dot_v in [0.1, 1], n_dot_l in [0.05, 1], r_dot_l in [0, 1]
// cost: 70 cycles, 10 registers on gcn
// error: RMSE 0.03743, max 0.38849 on the search split
//        RMSE 0.03593, max 0.36631 on the validation split
// finite: proved
// range: proved
// formula: t0 = roughness^2; t1 = t0^2; t2 = 1 - t1; t3 = 0.5*sin_half_omega; t4 = n_dot_v + n_dot_l; t5 = n_dot_v*n_dot_l; t6 = saturate(0.5*(t4^2/(2*t5 + 1 - r_dot_l))); t7 = 2 - 2*t6; t8 = 0.96*n_dot_l; t9 = sin_half_omega^2*max(-0.14 - (5.36 - 6*r_dot_l)/n_dot_v + 5.8*t7, 0.1); t10 = t1*(2 - t9 - t7); t11 = t9 - t7; t12 = t10 + t11; lobe = saturate(1.92*((t1 + t3^2)*(t5/(sqrt(t1 + n_dot_v*(n_dot_v*t2))*t8 + n_dot_v*sqrt(t1 + t8*(t2*t8))))*(1 - (t10 - t11)*rsqrt(max(8*(t6*(t1*t7)) + t12^2, 1e-9)))/t9))
// template: a = roughness*roughness; a2 = a*a; b = 1 - a2; i = 0.5*sin_half_omega; u = n_dot_l + n_dot_v; s = 2 - 2*saturate(0.5*u*u/(1 + 2*n_dot_v*n_dot_l - r_dot_l)); k = sin_half_omega*sin_half_omega*max(w(n_dot_v, s, r_dot_l, a), 0.1); q = a2*(2 - k - s); z = k - s; t = q + z; x = max(c(n_dot_l, r_dot_l, n_dot_v, a, sin_half_omega), 0.01); g = 2*x*n_dot_v/(x*sqrt(a2 + b*n_dot_v*n_dot_v) + n_dot_v*sqrt(a2 + b*x*x)); lobe = saturate(g*(a2 + i*i)*(1 - (q - z)*rsqrt(max(4*a2*s*(2 - s) + t*t, 1e-9)))/k)
// with w(n_dot_v, s, r_dot_l, a) = -0.14 - (5.36 - 6*r_dot_l)/n_dot_v + 5.8*s
// with c(n_dot_l, r_dot_l, n_dot_v, a, sin_half_omega) = 0.96*n_dot_l
float sphere_light_lobe(float sin_half_omega, float roughness, float n_dot_v, float n_dot_l, float r_dot_l) {
    const float t0 = roughness*roughness;
    const float t1 = t0*t0;
    const float t2 = 1.0 - t1;
    const float t3 = 0.5*sin_half_omega;
    const float t4 = n_dot_v + n_dot_l;
    const float t5 = n_dot_v*n_dot_l;
    const float t6 = saturate(0.5*(t4*t4/(2.0*t5 + 1.0 - r_dot_l)));
    const float t7 = 2.0 - 2.0*t6;
    const float t8 = 0.96*n_dot_l;
    const float t9 = max(-0.14 - (5.36 - 6.0*r_dot_l)/n_dot_v + 5.8*t7, 0.1);
    const float t10 = sin_half_omega*sin_half_omega*t9;
    const float t11 = t1*(2.0 - t10 - t7);
    const float t12 = t10 - t7;
    const float t13 = t11 + t12;
    const float t14 = t5/(sqrt(t1 + n_dot_v*(n_dot_v*t2))*t8 + n_dot_v*sqrt(t1 + t8*(t2*t8)));
    const float t15 = 1.0 - (t11 - t12)*rsqrt(max(8.0*(t6*(t1*t7)) + t13*t13, 1e-9));
    const float lobe = saturate(1.92*((t1 + t3*t3)*t14*t15/t10));
    return lobe;
}
