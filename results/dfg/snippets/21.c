// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 20 cycles on gcn
// error: RMSE 0.00571, max 0.04422 on the search split
//        RMSE 0.00575, max 0.06361 on the validation split
//        scale: RMSE 0.00680, max 0.04131
//        bias: RMSE 0.00435, max 0.04422
// finite on every sample of both splits
// t0 = roughness - 0.25*n_dot_v; t1 = max(t0, 0.03); t2 = max(n_dot_v, roughness) - 0.69*n_dot_v; bias = exp2(t2*(-0.885 - t1*(12.9 - 9.9*t2)) - 0.0527 - n_dot_v*(6.42*n_dot_v + 6.1)); t3 = n_dot_v*(0.02195 - t0*t1); t4 = 1.077*t3 + 0.8722; scale = t4*(min(t4, 0.8558) + bias*(29.37*t3 - 1.2005)) + 0.23349
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = roughness - 0.25f*n_dot_v;
    const float t1 = fmaxf(t0, 0.03f);
    const float t2 = fmaxf(n_dot_v, roughness) - 0.69f*n_dot_v;
    const float t3 = t2*(-0.885f - t1*(12.9f - 9.9f*t2)) - 0.0527f;
    const float bias = exp2f(t3 - n_dot_v*(6.42f*n_dot_v + 6.1f));
    const float t4 = n_dot_v*(0.02195f - t0*t1);
    const float t5 = 1.077f*t4 + 0.8722f;
    const float scale = t5*(fminf(t5, 0.8558f) + bias*(29.37f*t4 - 1.2005f)) + 0.23349f;
    const dfg_outputs result = { scale, bias };
    return result;
}
