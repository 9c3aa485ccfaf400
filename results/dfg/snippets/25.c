// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 24 cycles on gcn
// error: RMSE 0.00512, max 0.04708 on the search split
//        RMSE 0.00519, max 0.09752 on the validation split
//        scale: RMSE 0.00591, max 0.04537
//        bias: RMSE 0.00420, max 0.04708
// finite on every sample of both splits
// t0 = saturate(saturate(roughness*(-n_dot_v - 0.76) + 1.022 + 1.51*n_dot_v) - 1.1*n_dot_v); t1 = n_dot_v*roughness; t2 = t1*(1.65*roughness - 2.61) - (roughness*(1.067*roughness - 1.849) + 0.993 - 1.313*n_dot_v); t3 = 0.01595*((t1*(30*roughness + 34) + 1.25)*(roughness - 0.4145*n_dot_v)) - 0.0139; t4 = saturate(t3 + 0.02734*n_dot_v); bias = saturate(t0*(t0 + 3.4*roughness)*(t2^2 + 0.0065)); scale = t4*(t4 - 1.7214) + 0.99778 + bias*(-22.01*t3 - 1.3175)
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = roughness*(-n_dot_v - 0.76f) + 1.022f + 1.51f*n_dot_v;
    const float t1 = fminf(fmaxf(fminf(fmaxf(t0, 0.0f), 1.0f) - 1.1f*n_dot_v, 0.0f), 1.0f);
    const float t2 = n_dot_v*roughness;
    const float t3 = roughness*(1.067f*roughness - 1.849f) + 0.993f - 1.313f*n_dot_v;
    const float t4 = t2*(1.65f*roughness - 2.61f) - t3;
    const float t5 = (t2*(30.0f*roughness + 34.0f) + 1.25f)*(roughness - 0.4145f*n_dot_v);
    const float t6 = 0.01595f*t5 - 0.0139f;
    const float t7 = fminf(fmaxf(t6 + 0.02734f*n_dot_v, 0.0f), 1.0f);
    const float bias = fminf(fmaxf(t1*(t1 + 3.4f*roughness)*(t4*t4 + 0.0065f), 0.0f), 1.0f);
    const float scale = t7*(t7 - 1.7214f) + 0.99778f + bias*(-22.01f*t6 - 1.3175f);
    const dfg_outputs result = { scale, bias };
    return result;
}
