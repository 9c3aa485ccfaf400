// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 28 cycles on gcn
// error: RMSE 0.00431, max 0.06584 on the search split
//        RMSE 0.00435, max 0.10248 on the validation split
//        scale: RMSE 0.00484, max 0.03004
//        bias: RMSE 0.00370, max 0.06584
// finite on every sample of both splits
// t0 = saturate(saturate(1.04 - 0.87*roughness + 1.14*n_dot_v) - 1.3*n_dot_v); t1 = t0 + 3.6*roughness; t2 = n_dot_v*roughness; t3 = abs(roughness*(1.18*roughness - 1.79) + 1.026) - 1.194*n_dot_v - t2*(1.5*roughness - 2.25); t4 = (1.2 - 2*(roughness*(50*t2 + 0.35)))*(0.0000772*(n_dot_v*(144 - 100*roughness)) - 0.01061) + 0.01417; t5 = saturate(t4 - 0.0488*n_dot_v); bias = saturate(t0*t1*(t3*(t3 - 0.072*t1) + 0.0172)); scale = t5*(t5 - 1.675) + 0.99704 + bias*(t4*(bias*(315*n_dot_v - 85.46) - 15.363) - 0.8442)
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fminf(fmaxf(1.04f - 0.87f*roughness + 1.14f*n_dot_v, 0.0f), 1.0f);
    const float t1 = fminf(fmaxf(t0 - 1.3f*n_dot_v, 0.0f), 1.0f);
    const float t2 = t1 + 3.6f*roughness;
    const float t3 = n_dot_v*roughness;
    const float t4 = fabsf(roughness*(1.18f*roughness - 1.79f) + 1.026f) - 1.194f*n_dot_v;
    const float t5 = t4 - t3*(1.5f*roughness - 2.25f);
    const float t6 = 0.0000772f*(n_dot_v*(144.0f - 100.0f*roughness)) - 0.01061f;
    const float t7 = (1.2f - 2.0f*(roughness*(50.0f*t3 + 0.35f)))*t6 + 0.01417f;
    const float t8 = fminf(fmaxf(t7 - 0.0488f*n_dot_v, 0.0f), 1.0f);
    const float bias = fminf(fmaxf(t1*t2*(t5*(t5 - 0.072f*t2) + 0.0172f), 0.0f), 1.0f);
    const float t9 = bias*(t7*(bias*(315.0f*n_dot_v - 85.46f) - 15.363f) - 0.8442f);
    const float scale = t8*(t8 - 1.675f) + 0.99704f + t9;
    const dfg_outputs result = { scale, bias };
    return result;
}
