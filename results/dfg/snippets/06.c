// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 5 cycles on gcn
// error: RMSE 0.03136, max 0.15166 on the search split
//        RMSE 0.03134, max 0.17100 on the validation split
//        scale: RMSE 0.03341, max 0.15166
//        bias: RMSE 0.02916, max 0.14594
// finite on every sample of both splits
// t0 = 0.85 - 1.45*roughness; t1 = n_dot_v*t0 - 0.008; bias = saturate(t0 - 2.45*abs(t1)); scale = saturate(0.93*t1 + 0.796) - 0.77*bias
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = 0.85f - 1.45f*roughness;
    const float t1 = n_dot_v*t0 - 0.008f;
    const float bias = fminf(fmaxf(t0 - 2.45f*fabsf(t1), 0.0f), 1.0f);
    const float scale = fminf(fmaxf(0.93f*t1 + 0.796f, 0.0f), 1.0f) - 0.77f*bias;
    const dfg_outputs result = { scale, bias };
    return result;
}
