// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 20 cycles on gcn
// error: RMSE 0.00598, max 0.06006 on the search split
//        RMSE 0.00605, max 0.10265 on the validation split
//        scale: RMSE 0.00715, max 0.03615
//        bias: RMSE 0.00451, max 0.06006
// finite on every sample of both splits
// t0 = n_dot_v + 1.1; t1 = (n_dot_v - 0.33*roughness)*(1.76 - 0.5*t0) - 1.57; t2 = roughness*t1; t3 = t2 + 0.49; t4 = saturate(n_dot_v - 0.69*(t2 + 0.1) + (0.52*t3 + 0.645 - 0.37*t0)*max(roughness, 2.62*t1 + 4.196)); bias = t4*(t4 - 1.977) + 0.9783; scale = bias*(2.35 - 3.3*(saturate(t0 - 0.56*roughness) + 0.18*roughness)) + (saturate(n_dot_v*t3 + 0.952) - 0.051*roughness)
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = n_dot_v + 1.1f;
    const float t1 = (n_dot_v - 0.33f*roughness)*(1.76f - 0.5f*t0) - 1.57f;
    const float t2 = roughness*t1;
    const float t3 = t2 + 0.49f;
    const float t4 = (0.52f*t3 + 0.645f - 0.37f*t0)*fmaxf(roughness, 2.62f*t1 + 4.196f);
    const float t5 = fminf(fmaxf(n_dot_v - 0.69f*(t2 + 0.1f) + t4, 0.0f), 1.0f);
    const float bias = t5*(t5 - 1.977f) + 0.9783f;
    const float t6 = 3.3f*(fminf(fmaxf(t0 - 0.56f*roughness, 0.0f), 1.0f) + 0.18f*roughness);
    const float t7 = fminf(fmaxf(n_dot_v*t3 + 0.952f, 0.0f), 1.0f) - 0.051f*roughness;
    const float scale = bias*(2.35f - t6) + t7;
    const dfg_outputs result = { scale, bias };
    return result;
}
