// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 8 cycles on gcn
// error: RMSE 0.01833, max 0.09212 on the search split
//        RMSE 0.01834, max 0.12956 on the validation split
//        scale: RMSE 0.02037, max 0.09212
//        bias: RMSE 0.01602, max 0.07833
// finite on every sample of both splits
// t0 = saturate(saturate(roughness*(2.7*n_dot_v - 1.27) + 1.05) - 1.9*n_dot_v); bias = t0^2 + 0.009; scale = saturate(n_dot_v*(roughness*(0.57*n_dot_v - 1.8) + 0.69) + 0.879) - 0.891*bias
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fminf(fmaxf(roughness*(2.7f*n_dot_v - 1.27f) + 1.05f, 0.0f), 1.0f);
    const float t1 = fminf(fmaxf(t0 - 1.9f*n_dot_v, 0.0f), 1.0f);
    const float bias = t1*t1 + 0.009f;
    const float t2 = n_dot_v*(roughness*(0.57f*n_dot_v - 1.8f) + 0.69f) + 0.879f;
    const float scale = fminf(fmaxf(t2, 0.0f), 1.0f) - 0.891f*bias;
    const dfg_outputs result = { scale, bias };
    return result;
}
