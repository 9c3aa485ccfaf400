// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 36 cycles on gcn
// error: RMSE 0.00282, max 0.03181 on the search split
//        RMSE 0.00294, max 0.07150 on the validation split
//        scale: RMSE 0.00312, max 0.02931
//        bias: RMSE 0.00247, max 0.03181
// finite on every sample of both splits
// t0 = saturate(1.024 - 0.6*roughness + 0.45*n_dot_v) - 1.2*n_dot_v; t1 = n_dot_v + 7*roughness; t2 = t1 + 0.7; t3 = roughness*(0.545*t2 - 2.75) + 0.3033 - 0.392*n_dot_v; t4 = t3 - min(roughness, saturate(0.916*roughness + n_dot_v*(0.234 - 0.16*n_dot_v)))*(3.8*roughness - 2.07); bias = t4^2*(t0*(t0*(23*roughness + 7 - 28*(roughness^2 - 0.06)) + 1.8) + 0.18); t5 = (9 - 100*((roughness - 0.44*n_dot_v)*(n_dot_v*roughness + 0.032)))*(1e-5 - 0.0067*t0 - 0.0049*n_dot_v); t6 = t5 + 0.0507; scale = t1*(t6*(t5 - 0.603)) + 1.0006 + bias*(0.997*t3 - 1.7695 - 55*(t6 - 0.00754*t2 + 0.0069*bias))
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fminf(fmaxf(1.024f - 0.6f*roughness + 0.45f*n_dot_v, 0.0f), 1.0f);
    const float t1 = t0 - 1.2f*n_dot_v;
    const float t2 = n_dot_v + 7.0f*roughness;
    const float t3 = t2 + 0.7f;
    const float t4 = roughness*(0.545f*t3 - 2.75f) + 0.3033f - 0.392f*n_dot_v;
    const float t5 = 0.916f*roughness + n_dot_v*(0.234f - 0.16f*n_dot_v);
    const float t6 = fminf(roughness, fminf(fmaxf(t5, 0.0f), 1.0f))*(3.8f*roughness - 2.07f);
    const float t7 = t4 - t6;
    const float t8 = t1*(23.0f*roughness + 7.0f - 28.0f*(roughness*roughness - 0.06f)) + 1.8f;
    const float bias = t7*t7*(t1*t8 + 0.18f);
    const float t9 = 9.0f - 100.0f*((roughness - 0.44f*n_dot_v)*(n_dot_v*roughness + 0.032f));
    const float t10 = t9*(1e-5f - 0.0067f*t1 - 0.0049f*n_dot_v);
    const float t11 = t10 + 0.0507f;
    const float t12 = bias*(0.997f*t4 - 1.7695f - 55.0f*(t11 - 0.00754f*t3 + 0.0069f*bias));
    const float scale = t2*(t11*(t10 - 0.603f)) + 1.0006f + t12;
    const dfg_outputs result = { scale, bias };
    return result;
}
