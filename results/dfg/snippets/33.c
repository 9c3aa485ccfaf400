// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 32 cycles on gcn
// error: RMSE 0.00351, max 0.04375 on the search split
//        RMSE 0.00361, max 0.07488 on the validation split
//        scale: RMSE 0.00392, max 0.03930
//        bias: RMSE 0.00303, max 0.04375
// finite on every sample of both splits
// t0 = saturate(1.035 - 0.65*roughness + 0.5*n_dot_v) - 0.9*n_dot_v; t1 = n_dot_v + 16*roughness; t2 = t1 - 0.06; t3 = 0.969*roughness; t4 = t3*(0.3129*t2 - 3.178) + 0.2049 - 0.256*n_dot_v; t5 = t4 - min(roughness, t3 + 0.088*n_dot_v)*(4.8*roughness - 2.86); bias = t5^2*(t0*(t0*(50*roughness + 35) - 12) + 0.48); t6 = (-100*((roughness - 0.4*n_dot_v)*(n_dot_v*roughness + 0.0793) - 0.09) - 1.1)*(-0.00344*t0 - 0.000497 - 0.001704*n_dot_v); t7 = t6 + 0.0271; scale = t1*(t7*(t6 - 0.39174)) + 0.99288 + bias*(0.717*t4 - 1.4764 - 86*(t7 - 0.003174*t2))
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fminf(fmaxf(1.035f - 0.65f*roughness + 0.5f*n_dot_v, 0.0f), 1.0f);
    const float t1 = t0 - 0.9f*n_dot_v;
    const float t2 = n_dot_v + 16.0f*roughness;
    const float t3 = t2 - 0.06f;
    const float t4 = 0.969f*roughness;
    const float t5 = t4*(0.3129f*t3 - 3.178f) + 0.2049f - 0.256f*n_dot_v;
    const float t6 = t5 - fminf(roughness, t4 + 0.088f*n_dot_v)*(4.8f*roughness - 2.86f);
    const float bias = t6*t6*(t1*(t1*(50.0f*roughness + 35.0f) - 12.0f) + 0.48f);
    const float t7 = (roughness - 0.4f*n_dot_v)*(n_dot_v*roughness + 0.0793f) - 0.09f;
    const float t8 = (-100.0f*t7 - 1.1f)*(-0.00344f*t1 - 0.000497f - 0.001704f*n_dot_v);
    const float t9 = t8 + 0.0271f;
    const float t10 = bias*(0.717f*t5 - 1.4764f - 86.0f*(t9 - 0.003174f*t3));
    const float scale = t2*(t9*(t8 - 0.39174f)) + 0.99288f + t10;
    const dfg_outputs result = { scale, bias };
    return result;
}
