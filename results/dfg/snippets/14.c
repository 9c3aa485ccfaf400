// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 13 cycles on gcn
// error: RMSE 0.00981, max 0.09484 on the search split
//        RMSE 0.00983, max 0.08990 on the validation split
//        scale: RMSE 0.01135, max 0.06041
//        bias: RMSE 0.00797, max 0.09484
// finite on every sample of both splits
// t0 = 1.24*roughness - 0.09; t1 = max(n_dot_v, t0); t2 = n_dot_v*(3*t1 - 6.2) + 0.51; t3 = (0.173 - 0.076*t1)*(t2 - 7.29*t1) + 0.8844; bias = t3^2; scale = (t0*(t1 + t2*(n_dot_v - 1.8*roughness)) + 0.84)*(-1.26*bias - 0.2002) + 1.1692
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = 1.24f*roughness - 0.09f;
    const float t1 = fmaxf(n_dot_v, t0);
    const float t2 = n_dot_v*(3.0f*t1 - 6.2f) + 0.51f;
    const float t3 = (0.173f - 0.076f*t1)*(t2 - 7.29f*t1) + 0.8844f;
    const float bias = t3*t3;
    const float t4 = t0*(t1 + t2*(n_dot_v - 1.8f*roughness)) + 0.84f;
    const float scale = t4*(-1.26f*bias - 0.2002f) + 1.1692f;
    const dfg_outputs result = { scale, bias };
    return result;
}
