// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 35 cycles on gcn
// error: RMSE 0.00295, max 0.03422 on the search split
//        RMSE 0.00307, max 0.07221 on the validation split
//        scale: RMSE 0.00328, max 0.03185
//        bias: RMSE 0.00257, max 0.03422
// finite on every sample of both splits
// t0 = saturate(1.03 - 0.7*roughness + 0.52*n_dot_v) - 1.22*n_dot_v; t1 = 26*roughness; t2 = n_dot_v + 8*roughness; t3 = t2 + 0.7; t4 = roughness*(0.4893*t3 - 2.778) + 0.2833 - 0.369*n_dot_v; t5 = t4 - min(roughness, saturate(0.93*roughness + 0.187*n_dot_v))*(3.88*roughness - 2.16); bias = t5^2*(t0*(t0*(t1 - 1.16*(roughness*t1 - 8)) + 2.65) + 0.27); t6 = (9.4 - 100*((roughness - 0.438*n_dot_v)*(n_dot_v*roughness + 0.035)))*(-0.00528*t0 - 0.00088 - 0.00361*n_dot_v); t7 = t6 + 0.04893; scale = t2*(t7*(t6 - 0.56766)) + 1.00027 + bias*(1.031*t4 - 1.7358 - 58.9*(t7 - 0.006512*t3 + 0.00655*bias))
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fminf(fmaxf(1.03f - 0.7f*roughness + 0.52f*n_dot_v, 0.0f), 1.0f);
    const float t1 = t0 - 1.22f*n_dot_v;
    const float t2 = 26.0f*roughness;
    const float t3 = n_dot_v + 8.0f*roughness;
    const float t4 = t3 + 0.7f;
    const float t5 = roughness*(0.4893f*t4 - 2.778f) + 0.2833f - 0.369f*n_dot_v;
    const float t6 = fminf(fmaxf(0.93f*roughness + 0.187f*n_dot_v, 0.0f), 1.0f);
    const float t7 = t5 - fminf(roughness, t6)*(3.88f*roughness - 2.16f);
    const float bias = t7*t7*(t1*(t1*(t2 - 1.16f*(roughness*t2 - 8.0f)) + 2.65f) + 0.27f);
    const float t8 = 100.0f*((roughness - 0.438f*n_dot_v)*(n_dot_v*roughness + 0.035f));
    const float t9 = (9.4f - t8)*(-0.00528f*t1 - 0.00088f - 0.00361f*n_dot_v);
    const float t10 = t9 + 0.04893f;
    const float t11 = bias*(1.031f*t5 - 1.7358f - 58.9f*(t10 - 0.006512f*t4 + 0.00655f*bias));
    const float scale = t3*(t10*(t9 - 0.56766f)) + 1.00027f + t11;
    const dfg_outputs result = { scale, bias };
    return result;
}
