// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 12 cycles on gcn
// error: RMSE 0.01264, max 0.09696 on the search split
//        RMSE 0.01265, max 0.10277 on the validation split
//        scale: RMSE 0.01523, max 0.09696
//        bias: RMSE 0.00935, max 0.04851
// finite on every sample of both splits
// t0 = max(roughness - 0.31*n_dot_v, -0.008); t1 = 0.031 - 0.03*max(n_dot_v, roughness); t2 = t1*(265*n_dot_v - 144) - 1.38; bias = t1*(t2^2 - 0.8); t3 = t0*(n_dot_v*t0 + 0.06) - 0.904; scale = t3*(t3 + 1.18*bias) + 0.182
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fmaxf(roughness - 0.31f*n_dot_v, -0.008f);
    const float t1 = 0.031f - 0.03f*fmaxf(n_dot_v, roughness);
    const float t2 = t1*(265.0f*n_dot_v - 144.0f) - 1.38f;
    const float bias = t1*(t2*t2 - 0.8f);
    const float t3 = t0*(n_dot_v*t0 + 0.06f) - 0.904f;
    const float scale = t3*(t3 + 1.18f*bias) + 0.182f;
    const dfg_outputs result = { scale, bias };
    return result;
}
