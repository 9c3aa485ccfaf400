// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 11 cycles on gcn
// error: RMSE 0.01328, max 0.07754 on the search split
//        RMSE 0.01329, max 0.08990 on the validation split
//        scale: RMSE 0.01509, max 0.07754
//        bias: RMSE 0.01118, max 0.06241
// finite on every sample of both splits
// t0 = roughness - 0.31*n_dot_v; t1 = (0.0267 - 0.03*max(n_dot_v, roughness))*(36 - 52*n_dot_v) + 0.03; bias = t1^2 + 0.004; t2 = (n_dot_v*t0 + 0.07)*max(t0, 0.01) - 0.898; scale = t2*(t2 + 1.2005*bias) + 0.1976
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = roughness - 0.31f*n_dot_v;
    const float t1 = (0.0267f - 0.03f*fmaxf(n_dot_v, roughness))*(36.0f - 52.0f*n_dot_v);
    const float t2 = t1 + 0.03f;
    const float bias = t2*t2 + 0.004f;
    const float t3 = (n_dot_v*t0 + 0.07f)*fmaxf(t0, 0.01f) - 0.898f;
    const float scale = t3*(t3 + 1.2005f*bias) + 0.1976f;
    const dfg_outputs result = { scale, bias };
    return result;
}
