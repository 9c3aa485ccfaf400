// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 6 cycles on gcn
// error: RMSE 0.02833, max 0.16504 on the search split
//        RMSE 0.02827, max 0.16502 on the validation split
//        scale: RMSE 0.03194, max 0.15116
//        bias: RMSE 0.02419, max 0.16504
// finite on every sample of both splits
// t0 = saturate(saturate(2.1 - 2*roughness) - 2.4*n_dot_v); t1 = 0.83 - 1.37*roughness; scale = saturate(t1*(n_dot_v - 0.78*t0) + 0.77); bias = t0*abs(t1) + 0.01
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fminf(fmaxf(2.1f - 2.0f*roughness, 0.0f), 1.0f) - 2.4f*n_dot_v;
    const float t1 = fminf(fmaxf(t0, 0.0f), 1.0f);
    const float t2 = 0.83f - 1.37f*roughness;
    const float scale = fminf(fmaxf(t2*(n_dot_v - 0.78f*t1) + 0.77f, 0.0f), 1.0f);
    const float bias = t1*fabsf(t2) + 0.01f;
    const dfg_outputs result = { scale, bias };
    return result;
}
