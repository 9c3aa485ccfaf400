// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 14 cycles on gcn
// error: RMSE 0.00848, max 0.11930 on the search split
//        RMSE 0.00851, max 0.11079 on the validation split
//        scale: RMSE 0.00997, max 0.06053
//        bias: RMSE 0.00667, max 0.11930
// finite on every sample of both splits
// t0 = 1.44*roughness - 0.11; t1 = max(n_dot_v, t0); t2 = n_dot_v*(t1*(6.1 - 2.4*roughness) - 7.5) + 0.59; t3 = (0.1822 - 0.069*t1)*(t2 - 6.04*t1) + 0.8745; bias = t3^2; scale = (t0*(t1 + t2*(n_dot_v - 1.8*roughness)) + 0.86)*(-1.236*bias - 0.1812) + 1.1625
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = 1.44f*roughness - 0.11f;
    const float t1 = fmaxf(n_dot_v, t0);
    const float t2 = n_dot_v*(t1*(6.1f - 2.4f*roughness) - 7.5f) + 0.59f;
    const float t3 = (0.1822f - 0.069f*t1)*(t2 - 6.04f*t1) + 0.8745f;
    const float bias = t3*t3;
    const float t4 = t0*(t1 + t2*(n_dot_v - 1.8f*roughness)) + 0.86f;
    const float scale = t4*(-1.236f*bias - 0.1812f) + 1.1625f;
    const dfg_outputs result = { scale, bias };
    return result;
}
