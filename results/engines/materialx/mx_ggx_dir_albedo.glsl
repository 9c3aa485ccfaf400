// n_dot_v, alpha -> bias, total
// data: dfg_alpha (540319825903ecb8), seed 1, lgp 0.1.0
// derived: total = scale + bias
// domain: n_dot_v in [0, 1], alpha in [0, 1]
// cost: 16 cycles, 4 registers on gcn
// error: RMSE 0.00481, max 0.09749 on the search split
//        RMSE 0.00488, max 0.14797 on the validation split
//        bias: RMSE 0.00414, max 0.06546
//        total: RMSE 0.00539, max 0.09749
// finite: proved
// range: proved
// formula: t0 = saturate(alpha - 0.14*n_dot_v); t1 = (alpha*(2.15 - 0.8*alpha) - 2.11)*t0 + 0.793; t2 = t1*(t1 + 2.44*(n_dot_v*(alpha - 0.64*t1))) + 0.284 - 0.8*n_dot_v; t3 = t2*abs(t2) + 0.017; t4 = t0*(t2*(t3*(43*n_dot_v - 50.6) - 2.27) - 1.189); total = n_dot_v*t4 + 0.9915; bias = saturate(t3 + 0.0167*t4)
// as it is called here: 24 cycles on gcn
// names: NdotV = n_dot_v
// let: return = F0*max(total - bias, 0) + F90*bias
// call: mx_ggx_dir_albedo_analytic(NdotV, alpha, F0, F90)
// names: return_x = return.x
// names: return_y = return.y
// names: return_z = return.z
vec3 mx_ggx_dir_albedo_analytic(float NdotV, float alpha, vec3 F0, vec3 F90) {
    float t0 = clamp(alpha - 0.14*NdotV, 0.0, 1.0);
    float t1 = (alpha*(2.15 - 0.8*alpha) - 2.11)*t0 + 0.793;
    float t2 = t1*(t1 + 2.44*(NdotV*(alpha - 0.64*t1))) + 0.284 - 0.8*NdotV;
    float t3 = t2*abs(t2) + 0.017;
    float t4 = t0*(t2*(t3*(43.0*NdotV - 50.6) - 2.27) - 1.189);
    float t5 = clamp(t3 + 0.0167*t4, 0.0, 1.0);
    float t6 = max(NdotV*t4 + 0.9915 - t5, 0.0);
    float return_x = F0.x*t6 + F90.x*t5;
    float return_y = F0.y*t6 + F90.y*t5;
    float return_z = F0.z*t6 + F90.z*t5;
    return vec3(return_x, return_y, return_z);
}
