// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 37 cycles on gcn
// error: RMSE 0.00274, max 0.03488 on the search split
//        RMSE 0.00287, max 0.07288 on the validation split
//        scale: RMSE 0.00295, max 0.02931
//        bias: RMSE 0.00252, max 0.03488
// finite on every sample of both splits
// t0 = 1.02 - 0.5*roughness; t1 = saturate(t0 + 0.39*n_dot_v) - 1.2*n_dot_v; t2 = 25*roughness + 6.18; t3 = n_dot_v + 5.1*roughness; t4 = t3 + 1; t5 = roughness*(0.65768*t4 - 2.71253) + 0.38789 - 0.47626*n_dot_v; t6 = t5 - min(roughness, 0.86805*roughness + 0.363*n_dot_v)*(3.29592*roughness - 1.736); bias = t6^2*(t1*(t1*(t2 - 1.856*(t2*(roughness*t0))) + 0.313) + 0.0139); t7 = (14.297806 - 203.36*((roughness - 0.45189*n_dot_v)*(n_dot_v*roughness + 0.035241593)))*(0.0012893982 - 0.006223436*t1 - 0.0049482*n_dot_v); t8 = t7 + 0.06318; scale = (t3 - 0.84)*(t8*(t7 - 0.71097)) + 0.9992921 + (1.0851527*t5 - 2.04649 - 40.686*(t8 - 0.0145395*t4 + 0.00691584*bias))*abs(bias)
vec2 dfg(float n_dot_v, float roughness) {
    float t0 = 1.02 - 0.5*roughness;
    float t1 = clamp(t0 + 0.39*n_dot_v, 0.0, 1.0) - 1.2*n_dot_v;
    float t2 = 25.0*roughness + 6.18;
    float t3 = n_dot_v + 5.1*roughness;
    float t4 = t3 + 1.0;
    float t5 = roughness*(0.65768*t4 - 2.71253) + 0.38789 - 0.47626*n_dot_v;
    float t6 = min(roughness, 0.86805*roughness + 0.363*n_dot_v);
    float t7 = t5 - t6*(3.29592*roughness - 1.736);
    float bias = t7*t7*(t1*(t1*(t2 - 1.856*(t2*(roughness*t0))) + 0.313) + 0.0139);
    float t8 = 203.36*((roughness - 0.45189*n_dot_v)*(n_dot_v*roughness + 0.035241593));
    float t9 = (14.297806 - t8)*(0.0012893982 - 0.006223436*t1 - 0.0049482*n_dot_v);
    float t10 = t9 + 0.06318;
    float t11 = 1.0851527*t5 - 2.04649 - 40.686*(t10 - 0.0145395*t4 + 0.00691584*bias);
    float scale = (t3 - 0.84)*(t10*(t9 - 0.71097)) + 0.9992921 + t11*abs(bias);
    return vec2(scale, bias);
}
