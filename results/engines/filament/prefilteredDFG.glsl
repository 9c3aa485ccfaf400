// n_dot_v, roughness -> bias, total
// data: dfg (d9bba53fa1b19ffd), seed 1, lgp 0.1.0
// derived: total = scale + bias
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 48 cycles, 7 registers on gcn
// error: RMSE 0.00181, max 0.02286 on the search split
//        RMSE 0.00237, max 0.09308 on the validation split
//        bias: RMSE 0.00138, max 0.02148
//        total: RMSE 0.00215, max 0.02286
// finite: proved
// range: proved
// formula: t0 = saturate(1.28*(n_dot_v + 0.94) - 1.9*roughness); t1 = saturate(1.23 - 1.1*roughness + 0.77*n_dot_v); t2 = t1 + n_dot_v*(2*roughness - 2.3); t3 = t2 - 0.52; t4 = abs(n_dot_v*(0.62*n_dot_v - 0.52) - (roughness*t3 + (0.04*t3 - 0.05 - t2))); t5 = n_dot_v*t4; t6 = t4 - 0.76*t5; t7 = t4 - 0.31*t5; t8 = t6*(t7 - 0.46*roughness); t9 = t0 + t4 - 0.747*t1; t10 = ((t4*(101.8 - 140*t7) - 27.96)*t9 - 7.58)*(t8 + 0.0113*t2) - 1.331; t11 = roughness*(0.7*n_dot_v + (roughness*t10 + (0.412*t2 - 0.023))); t12 = t10*(roughness*(0.00907*(t9*t11) + 0.0355) + 0.002301) + 0.99824; total = saturate(t11*(1.38*n_dot_v - 0.017) + (0.3046*t8 + t12)); t13 = saturate(0.5189*n_dot_v + 0.827419 + t0*(0.23*(n_dot_v + t12) - 0.03031 + 0.04081*t9)*abs(t6) - 0.4006*roughness) - 0.97707*n_dot_v; t14 = t13^2; bias = saturate(saturate(t14^2 + 0.00667)*(0.99023 - 1.129*n_dot_v))
// as it is called here: 49 cycles on gcn
// names: NoV = n_dot_v
// names: perceptualRoughness = roughness
// let: return.x = bias
// let: return.y = max(total, bias)
// let: return.z = 0
// call: prefilteredDFG(perceptualRoughness, NoV)
// names: return_x = return.x
// names: return_y = return.y
// names: return_z = return.z
vec3 prefilteredDFG(float perceptualRoughness, float NoV) {
    float t0 = clamp(1.28*(NoV + 0.94) - 1.9*perceptualRoughness, 0.0, 1.0);
    float t1 = clamp(1.23 - 1.1*perceptualRoughness + 0.77*NoV, 0.0, 1.0);
    float t2 = t1 + NoV*(2.0*perceptualRoughness - 2.3);
    float t3 = t2 - 0.52;
    float t4 = NoV*(0.62*NoV - 0.52) - (perceptualRoughness*t3 + (0.04*t3 - 0.05 - t2));
    float t5 = abs(t4);
    float t6 = NoV*t5;
    float t7 = t5 - 0.76*t6;
    float t8 = t5 - 0.31*t6;
    float t9 = t7*(t8 - 0.46*perceptualRoughness);
    float t10 = t0 + t5 - 0.747*t1;
    float t11 = ((t5*(101.8 - 140.0*t8) - 27.96)*t10 - 7.58)*(t9 + 0.0113*t2) - 1.331;
    float t12 = 0.7*NoV + (perceptualRoughness*t11 + (0.412*t2 - 0.023));
    float t13 = perceptualRoughness*t12;
    float t14 = t11*(perceptualRoughness*(0.00907*(t10*t13) + 0.0355) + 0.002301);
    float t15 = t14 + 0.99824;
    float t16 = t0*(0.23*(NoV + t15) - 0.03031 + 0.04081*t10)*abs(t7);
    float t17 = 0.5189*NoV + 0.827419 + t16 - 0.4006*perceptualRoughness;
    float t18 = clamp(t17, 0.0, 1.0) - 0.97707*NoV;
    float t19 = t18*t18;
    float t20 = clamp(t19*t19 + 0.00667, 0.0, 1.0)*(0.99023 - 1.129*NoV);
    float return_x = clamp(t20, 0.0, 1.0);
    float t21 = clamp(t13*(1.38*NoV - 0.017) + (0.3046*t9 + t15), 0.0, 1.0);
    float return_y = max(t21, return_x);
    float return_z = 0.0;
    return vec3(return_x, return_y, return_z);
}
