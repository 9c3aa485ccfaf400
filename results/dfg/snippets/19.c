// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 18 cycles on gcn
// error: RMSE 0.00605, max 0.06134 on the search split
//        RMSE 0.00607, max 0.06430 on the validation split
//        scale: RMSE 0.00685, max 0.03938
//        bias: RMSE 0.00512, max 0.06134
// finite on every sample of both splits
// t0 = roughness - 0.41*n_dot_v; t1 = max(t0, 0.05); bias = exp2((t1 - 0.36*n_dot_v)*(-1 - t1*(13.3 - 10.3*t0)) - 0.01 - n_dot_v*(7.8*n_dot_v + 6.66)); t2 = n_dot_v*(roughness*t1 - 0.019); t3 = 0.884 - 0.96*t2; scale = t3*(t3 + bias*(-22.4*t2 - 1.178)) + 0.2
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = roughness - 0.41f*n_dot_v;
    const float t1 = fmaxf(t0, 0.05f);
    const float t2 = (t1 - 0.36f*n_dot_v)*(-1.0f - t1*(13.3f - 10.3f*t0)) - 0.01f;
    const float bias = exp2f(t2 - n_dot_v*(7.8f*n_dot_v + 6.66f));
    const float t3 = n_dot_v*(roughness*t1 - 0.019f);
    const float t4 = 0.884f - 0.96f*t3;
    const float scale = t4*(t4 + bias*(-22.4f*t3 - 1.178f)) + 0.2f;
    const dfg_outputs result = { scale, bias };
    return result;
}
