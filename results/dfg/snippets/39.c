// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 38 cycles on gcn
// error: RMSE 0.00264, max 0.03155 on the search split
//        RMSE 0.00278, max 0.07101 on the validation split
//        scale: RMSE 0.00281, max 0.02710
//        bias: RMSE 0.00246, max 0.03155
// finite on every sample of both splits
// t0 = saturate(1.014 - 0.4*roughness + 0.317*n_dot_v) - 1.2*n_dot_v; t1 = roughness*(20 - 20*roughness) + 4.9; t2 = n_dot_v + 4.78*roughness; t3 = t2 + 0.9; t4 = roughness*(0.6974*t3 - 2.657) + 0.3774 - 0.464*n_dot_v; t5 = t4 - min(roughness, saturate(0.86*roughness + n_dot_v*(0.398 - 0.28*n_dot_v)))*(3.33*roughness - 1.705); bias = t5^2*(t0*(t0*(t1 - 1.13*(roughness*t1 - 1.46)) + 0.31) + 0.02); t6 = (19.3 - 300*((roughness - 0.452*n_dot_v)*(n_dot_v*roughness + 0.0326)))*(0.00192 - 0.00523*t0 - 0.0045*n_dot_v); t7 = t6 + 0.0455; t8 = t7 - 0.01407*t3; scale = t2*(t7*(t6 - 0.793)) + 1.0152 + bias*(t4 - 2.4215 - 41.6*(t8 + 0.00634*bias)) + 0.663*t8
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fminf(fmaxf(1.014f - 0.4f*roughness + 0.317f*n_dot_v, 0.0f), 1.0f);
    const float t1 = t0 - 1.2f*n_dot_v;
    const float t2 = roughness*(20.0f - 20.0f*roughness) + 4.9f;
    const float t3 = n_dot_v + 4.78f*roughness;
    const float t4 = t3 + 0.9f;
    const float t5 = roughness*(0.6974f*t4 - 2.657f) + 0.3774f - 0.464f*n_dot_v;
    const float t6 = 0.86f*roughness + n_dot_v*(0.398f - 0.28f*n_dot_v);
    const float t7 = fminf(roughness, fminf(fmaxf(t6, 0.0f), 1.0f));
    const float t8 = t5 - t7*(3.33f*roughness - 1.705f);
    const float bias = t8*t8*(t1*(t1*(t2 - 1.13f*(roughness*t2 - 1.46f)) + 0.31f) + 0.02f);
    const float t9 = 300.0f*((roughness - 0.452f*n_dot_v)*(n_dot_v*roughness + 0.0326f));
    const float t10 = (19.3f - t9)*(0.00192f - 0.00523f*t1 - 0.0045f*n_dot_v);
    const float t11 = t10 + 0.0455f;
    const float t12 = t11 - 0.01407f*t4;
    const float t13 = bias*(t5 - 2.4215f - 41.6f*(t12 + 0.00634f*bias));
    const float scale = t3*(t11*(t10 - 0.793f)) + 1.0152f + t13 + 0.663f*t12;
    const dfg_outputs result = { scale, bias };
    return result;
}
