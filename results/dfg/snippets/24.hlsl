// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 23 cycles on gcn
// error: RMSE 0.00547, max 0.04985 on the search split
//        RMSE 0.00553, max 0.09504 on the validation split
//        scale: RMSE 0.00643, max 0.04350
//        bias: RMSE 0.00431, max 0.04985
// finite on every sample of both splits
// t0 = saturate(saturate(roughness*(-0.7*n_dot_v - 0.8) + 1.026 + 1.46*n_dot_v) - 1.15*n_dot_v); t1 = n_dot_v*roughness; t2 = t1*(1.4*roughness - 2.31) - (roughness*(1.12*roughness - 1.869) + 0.991 - 1.24*n_dot_v); t3 = 0.02*((40*t1 + 1.03)*(roughness - 0.438*n_dot_v)) - 0.0156; t4 = saturate(t3 + 0.029*n_dot_v); bias = saturate(t0*(t0 + 3.6*roughness)*(t2^2 + 0.0042)); scale = t4*(t4 - 1.947) + 0.9968 + bias*(-21.3*t3 - 1.338)
float2 dfg(float n_dot_v, float roughness) {
    const float t0 = saturate(roughness*(-0.7*n_dot_v - 0.8) + 1.026 + 1.46*n_dot_v);
    const float t1 = saturate(t0 - 1.15*n_dot_v);
    const float t2 = n_dot_v*roughness;
    const float t3 = roughness*(1.12*roughness - 1.869) + 0.991 - 1.24*n_dot_v;
    const float t4 = t2*(1.4*roughness - 2.31) - t3;
    const float t5 = 0.02*((40.0*t2 + 1.03)*(roughness - 0.438*n_dot_v)) - 0.0156;
    const float t6 = saturate(t5 + 0.029*n_dot_v);
    const float bias = saturate(t1*(t1 + 3.6*roughness)*(t4*t4 + 0.0042));
    const float scale = t6*(t6 - 1.947) + 0.9968 + bias*(-21.3*t5 - 1.338);
    return float2(scale, bias);
}
