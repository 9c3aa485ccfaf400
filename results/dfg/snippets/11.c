// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 10 cycles on gcn
// error: RMSE 0.01304, max 0.07094 on the search split
//        RMSE 0.01305, max 0.08238 on the validation split
//        scale: RMSE 0.01452, max 0.07094
//        bias: RMSE 0.01137, max 0.05605
// finite on every sample of both splits
// t0 = (1.5*n_dot_v - 1.157)*max(n_dot_v, roughness) + 0.9966 - 1.3*n_dot_v; bias = t0^2 + 0.0081; scale = saturate(n_dot_v*(roughness*(n_dot_v*(2 - 0.92*n_dot_v) - 2.354) + 0.645) + 0.9272) - 1.001*bias
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = (1.5f*n_dot_v - 1.157f)*fmaxf(n_dot_v, roughness) + 0.9966f;
    const float t1 = t0 - 1.3f*n_dot_v;
    const float bias = t1*t1 + 0.0081f;
    const float t2 = n_dot_v*(roughness*(n_dot_v*(2.0f - 0.92f*n_dot_v) - 2.354f) + 0.645f);
    const float scale = fminf(fmaxf(t2 + 0.9272f, 0.0f), 1.0f) - 1.001f*bias;
    const dfg_outputs result = { scale, bias };
    return result;
}
