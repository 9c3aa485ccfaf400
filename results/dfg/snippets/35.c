// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 34 cycles on gcn
// error: RMSE 0.00314, max 0.03536 on the search split
//        RMSE 0.00327, max 0.07697 on the validation split
//        scale: RMSE 0.00350, max 0.03536
//        bias: RMSE 0.00272, max 0.03406
// finite on every sample of both splits
// t0 = saturate(1.03 - 0.76*roughness + 0.58*n_dot_v) - 1.3*n_dot_v; t1 = n_dot_v*roughness; t2 = saturate(t0 + 0.26*t1); t3 = n_dot_v + 9*roughness; t4 = t3 + 0.6; t5 = roughness*(0.4427*t4 - 2.869) + 0.2848 - 0.338*n_dot_v; t6 = t5 - min(roughness, 0.943*roughness + abs(-0.154*n_dot_v))*(3.9*roughness - 2.26); bias = t6^2*((t2*(30*roughness + 10) + 2)*t2 + 0.11); t7 = (11.4 - 100*(t1*(roughness - 0.446*n_dot_v)))*(-0.0044*t0 - 0.00157 - 0.00394*n_dot_v); t8 = t7 + 0.069; scale = t3*(t8*(t7 - 0.4593)) + 1.006 + bias*(1.218*t5 - 1.0273 - 58.4*(t8 - 0.004674*t4 + 0.00805*bias))
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fminf(fmaxf(1.03f - 0.76f*roughness + 0.58f*n_dot_v, 0.0f), 1.0f);
    const float t1 = t0 - 1.3f*n_dot_v;
    const float t2 = n_dot_v*roughness;
    const float t3 = fminf(fmaxf(t1 + 0.26f*t2, 0.0f), 1.0f);
    const float t4 = n_dot_v + 9.0f*roughness;
    const float t5 = t4 + 0.6f;
    const float t6 = roughness*(0.4427f*t5 - 2.869f) + 0.2848f - 0.338f*n_dot_v;
    const float t7 = fminf(roughness, 0.943f*roughness + fabsf(-0.154f*n_dot_v));
    const float t8 = t6 - t7*(3.9f*roughness - 2.26f);
    const float bias = t8*t8*((t3*(30.0f*roughness + 10.0f) + 2.0f)*t3 + 0.11f);
    const float t9 = 11.4f - 100.0f*(t2*(roughness - 0.446f*n_dot_v));
    const float t10 = t9*(-0.0044f*t1 - 0.00157f - 0.00394f*n_dot_v);
    const float t11 = t10 + 0.069f;
    const float t12 = bias*(1.218f*t6 - 1.0273f - 58.4f*(t11 - 0.004674f*t5 + 0.00805f*bias));
    const float scale = t4*(t11*(t10 - 0.4593f)) + 1.006f + t12;
    const dfg_outputs result = { scale, bias };
    return result;
}
