// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 4 cycles on gcn
// error: RMSE 0.08842, max 0.68459 on the search split
//        RMSE 0.08818, max 0.71523 on the validation split
//        scale: RMSE 0.08021, max 0.43147
//        bias: RMSE 0.09594, max 0.68459
// finite on every sample of both splits
// bias = 0.28 - 0.22*(n_dot_v + 0.8*roughness); scale = n_dot_v + bias*(5*roughness + 1.5)
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float bias = 0.28f - 0.22f*(n_dot_v + 0.8f*roughness);
    const float scale = n_dot_v + bias*(5.0f*roughness + 1.5f);
    const dfg_outputs result = { scale, bias };
    return result;
}
