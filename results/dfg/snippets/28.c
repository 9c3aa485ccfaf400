// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 27 cycles on gcn
// error: RMSE 0.00437, max 0.07594 on the search split
//        RMSE 0.00439, max 0.09900 on the validation split
//        scale: RMSE 0.00469, max 0.02893
//        bias: RMSE 0.00403, max 0.07594
// finite on every sample of both splits
// t0 = saturate(saturate(n_dot_v + (1.05 - 0.85*roughness)) - 1.3*n_dot_v); t1 = n_dot_v*roughness; t2 = abs(roughness*(1.12*roughness - 1.85) + 0.9959) - 1.125*n_dot_v - t1*(1.55*roughness - 2.246); t3 = (1.16 - 2*(roughness*(50*t1 + 0.287)))*(0.0000772*(n_dot_v*(145 - 100*roughness)) - 0.0107) + 0.01367; t4 = saturate(t3 - 0.04795*n_dot_v); bias = saturate(t0*(t0 + 3.3*roughness)*(t2^2 + 0.0048)); scale = t4*(t4 - 1.6719) + 0.99702 + bias*(t3*(bias*(366.4*n_dot_v - 92.7) - 15.6843) - 0.855428)
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fminf(fmaxf(n_dot_v + (1.05f - 0.85f*roughness), 0.0f), 1.0f);
    const float t1 = fminf(fmaxf(t0 - 1.3f*n_dot_v, 0.0f), 1.0f);
    const float t2 = n_dot_v*roughness;
    const float t3 = fabsf(roughness*(1.12f*roughness - 1.85f) + 0.9959f) - 1.125f*n_dot_v;
    const float t4 = t3 - t2*(1.55f*roughness - 2.246f);
    const float t5 = 0.0000772f*(n_dot_v*(145.0f - 100.0f*roughness)) - 0.0107f;
    const float t6 = (1.16f - 2.0f*(roughness*(50.0f*t2 + 0.287f)))*t5 + 0.01367f;
    const float t7 = fminf(fmaxf(t6 - 0.04795f*n_dot_v, 0.0f), 1.0f);
    const float bias = fminf(fmaxf(t1*(t1 + 3.3f*roughness)*(t4*t4 + 0.0048f), 0.0f), 1.0f);
    const float t8 = bias*(t6*(bias*(366.4f*n_dot_v - 92.7f) - 15.6843f) - 0.855428f);
    const float scale = t7*(t7 - 1.6719f) + 0.99702f + t8;
    const dfg_outputs result = { scale, bias };
    return result;
}
