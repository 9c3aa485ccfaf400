// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 16 cycles on gcn
// error: RMSE 0.00830, max 0.07676 on the search split
//        RMSE 0.00837, max 0.08948 on the validation split
//        scale: RMSE 0.00960, max 0.05433
//        bias: RMSE 0.00675, max 0.07676
// finite on every sample of both splits
// t0 = n_dot_v*(1.88 - 0.8*n_dot_v) + (-0.5*roughness - 1.63); t1 = roughness*t0; t2 = t1 + 0.377; t3 = saturate(n_dot_v - 0.63*(t1 + 0.13) + (0.53*t2 + 0.445 - 0.43*n_dot_v)*max(roughness, saturate(1.22*t0 + 2.118))); bias = (t3 - 2.003)*t3 + 1.0053; scale = saturate(n_dot_v*t2 + 0.95) - 0.00484 - 1.007*bias
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = n_dot_v*(1.88f - 0.8f*n_dot_v) + (-0.5f*roughness - 1.63f);
    const float t1 = roughness*t0;
    const float t2 = t1 + 0.377f;
    const float t3 = fmaxf(roughness, fminf(fmaxf(1.22f*t0 + 2.118f, 0.0f), 1.0f));
    const float t4 = n_dot_v - 0.63f*(t1 + 0.13f) + (0.53f*t2 + 0.445f - 0.43f*n_dot_v)*t3;
    const float t5 = fminf(fmaxf(t4, 0.0f), 1.0f);
    const float bias = (t5 - 2.003f)*t5 + 1.0053f;
    const float scale = fminf(fmaxf(n_dot_v*t2 + 0.95f, 0.0f), 1.0f) - 0.00484f - 1.007f*bias;
    const dfg_outputs result = { scale, bias };
    return result;
}
