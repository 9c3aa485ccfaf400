// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 14 cycles on gcn
// error: RMSE 0.00882, max 0.07856 on the search split
//        RMSE 0.00885, max 0.08146 on the validation split
//        scale: RMSE 0.01045, max 0.04700
//        bias: RMSE 0.00681, max 0.07856
// finite on every sample of both splits
// t0 = n_dot_v*(n_dot_v*(0.08*roughness - 0.6) + 0.7) - 0.86; t1 = roughness*t0 + 1.89; t2 = saturate(t1 + 0.94*t0); t3 = saturate(t2 - 1.56*n_dot_v); bias = t3*(t3*(t1*t3 - t3) + 0.071) + 0.004; scale = saturate(n_dot_v*(roughness*(0.84*n_dot_v + (t2 - 2.43)) + 0.341) + 0.946) - 1.009*abs(bias)
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = n_dot_v*(n_dot_v*(0.08f*roughness - 0.6f) + 0.7f) - 0.86f;
    const float t1 = roughness*t0 + 1.89f;
    const float t2 = fminf(fmaxf(t1 + 0.94f*t0, 0.0f), 1.0f);
    const float t3 = fminf(fmaxf(t2 - 1.56f*n_dot_v, 0.0f), 1.0f);
    const float bias = t3*(t3*(t1*t3 - t3) + 0.071f) + 0.004f;
    const float t4 = n_dot_v*(roughness*(0.84f*n_dot_v + (t2 - 2.43f)) + 0.341f) + 0.946f;
    const float scale = fminf(fmaxf(t4, 0.0f), 1.0f) - 1.009f*fabsf(bias);
    const dfg_outputs result = { scale, bias };
    return result;
}
