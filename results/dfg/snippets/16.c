// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 15 cycles on gcn
// error: RMSE 0.00839, max 0.07009 on the search split
//        RMSE 0.00846, max 0.08793 on the validation split
//        scale: RMSE 0.00969, max 0.05707
//        bias: RMSE 0.00685, max 0.07009
// finite on every sample of both splits
// t0 = n_dot_v*(2.03 - 0.9*n_dot_v) + (-0.54*roughness - 1.62); t1 = roughness*t0; t2 = t1 + 0.35; t3 = saturate(n_dot_v - 0.66*(t1 + 0.1) + (0.53*t2 + 0.39 - 0.34*n_dot_v)*max(roughness, saturate(1.236*t0 + 2.137))); bias = (t3 - 2.023)*t3 + 1.0267; scale = saturate(n_dot_v*t2 + 0.949) - 1.0126*bias
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = n_dot_v*(2.03f - 0.9f*n_dot_v) + (-0.54f*roughness - 1.62f);
    const float t1 = roughness*t0;
    const float t2 = t1 + 0.35f;
    const float t3 = fmaxf(roughness, fminf(fmaxf(1.236f*t0 + 2.137f, 0.0f), 1.0f));
    const float t4 = n_dot_v - 0.66f*(t1 + 0.1f) + (0.53f*t2 + 0.39f - 0.34f*n_dot_v)*t3;
    const float t5 = fminf(fmaxf(t4, 0.0f), 1.0f);
    const float bias = (t5 - 2.023f)*t5 + 1.0267f;
    const float scale = fminf(fmaxf(n_dot_v*t2 + 0.949f, 0.0f), 1.0f) - 1.0126f*bias;
    const dfg_outputs result = { scale, bias };
    return result;
}
