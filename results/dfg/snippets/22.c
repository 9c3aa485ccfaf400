// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 21 cycles on gcn
// error: RMSE 0.00553, max 0.05191 on the search split
//        RMSE 0.00559, max 0.06643 on the validation split
//        scale: RMSE 0.00646, max 0.04119
//        bias: RMSE 0.00440, max 0.05191
// finite on every sample of both splits
// t0 = roughness - 0.74*n_dot_v; t1 = roughness - 0.25*n_dot_v; bias = exp2(min(roughness + t0*(-1.5 - (11.5 - 9*t0)*t1), -0.05) - n_dot_v*(7*n_dot_v + 6.82) - t0); t2 = n_dot_v*(t1*max(t1, 0.04) - 0.023); t3 = 0.872 - 1.08*t2; scale = t3*(min(t3, 0.854) - bias*(28.5*t2 + 1.2)) + 0.2336
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = roughness - 0.74f*n_dot_v;
    const float t1 = roughness - 0.25f*n_dot_v;
    const float t2 = fminf(roughness + t0*(-1.5f - (11.5f - 9.0f*t0)*t1), -0.05f);
    const float bias = exp2f(t2 - n_dot_v*(7.0f*n_dot_v + 6.82f) - t0);
    const float t3 = n_dot_v*(t1*fmaxf(t1, 0.04f) - 0.023f);
    const float t4 = 0.872f - 1.08f*t3;
    const float scale = t4*(fminf(t4, 0.854f) - bias*(28.5f*t3 + 1.2f)) + 0.2336f;
    const dfg_outputs result = { scale, bias };
    return result;
}
