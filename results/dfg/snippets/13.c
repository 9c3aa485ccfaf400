// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 12 cycles on gcn
// error: RMSE 0.01092, max 0.06895 on the search split
//        RMSE 0.01095, max 0.08550 on the validation split
//        scale: RMSE 0.01315, max 0.06373
//        bias: RMSE 0.00809, max 0.06895
// finite on every sample of both splits
// t0 = 1.8*n_dot_v - 1.23; t1 = saturate(t0*max(n_dot_v, max(roughness, 0.05)) + 0.995 - 1.4*n_dot_v); bias = t1^2 - 0.033*t0; scale = saturate(n_dot_v*(roughness*(n_dot_v*(1.84 - 0.8*n_dot_v) + (-0.5*roughness - 1.6)) + 0.385) + 0.942) - 1.005*abs(bias)
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = 1.8f*n_dot_v - 1.23f;
    const float t1 = t0*fmaxf(n_dot_v, fmaxf(roughness, 0.05f)) + 0.995f - 1.4f*n_dot_v;
    const float t2 = fminf(fmaxf(t1, 0.0f), 1.0f);
    const float bias = t2*t2 - 0.033f*t0;
    const float t3 = roughness*(n_dot_v*(1.84f - 0.8f*n_dot_v) + (-0.5f*roughness - 1.6f));
    const float t4 = fminf(fmaxf(n_dot_v*(t3 + 0.385f) + 0.942f, 0.0f), 1.0f);
    const float scale = t4 - 1.005f*fabsf(bias);
    const dfg_outputs result = { scale, bias };
    return result;
}
