// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 33 cycles on gcn
// error: RMSE 0.00333, max 0.04570 on the search split
//        RMSE 0.00343, max 0.07120 on the validation split
//        scale: RMSE 0.00363, max 0.03485
//        bias: RMSE 0.00300, max 0.04570
// finite on every sample of both splits
// t0 = saturate(1.04 - 0.7*roughness + 0.52*n_dot_v) - 0.9*n_dot_v; t1 = n_dot_v + 8*roughness; t2 = t1 + 0.6; t3 = roughness*(0.486*t2 - 2.876) + 0.32473 - 0.412*n_dot_v; t4 = t3 - min(roughness, 0.937*roughness + 0.177*n_dot_v)*(3.8*roughness - 2.21); bias = t0*(t0*(20*roughness + 13) - 3.7)*t4^2; t5 = (10.4 - 100*((roughness - 0.444*n_dot_v)*(n_dot_v*roughness + 0.033)))*(-0.0049*t0 - 0.001 - 0.00235*n_dot_v); t6 = t5 + 0.059; scale = saturate(t1*(t6*(t5 - 0.52345)) + 1.00123 + bias*(1.207*t3 - 1.47746 - 60*(t6 - 0.007197*t2 + 0.00588*bias)))
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fminf(fmaxf(1.04f - 0.7f*roughness + 0.52f*n_dot_v, 0.0f), 1.0f);
    const float t1 = t0 - 0.9f*n_dot_v;
    const float t2 = n_dot_v + 8.0f*roughness;
    const float t3 = t2 + 0.6f;
    const float t4 = roughness*(0.486f*t3 - 2.876f) + 0.32473f - 0.412f*n_dot_v;
    const float t5 = fminf(roughness, 0.937f*roughness + 0.177f*n_dot_v);
    const float t6 = t4 - t5*(3.8f*roughness - 2.21f);
    const float bias = t1*(t1*(20.0f*roughness + 13.0f) - 3.7f)*(t6*t6);
    const float t7 = 100.0f*((roughness - 0.444f*n_dot_v)*(n_dot_v*roughness + 0.033f));
    const float t8 = (10.4f - t7)*(-0.0049f*t1 - 0.001f - 0.00235f*n_dot_v);
    const float t9 = t8 + 0.059f;
    const float t10 = bias*(1.207f*t4 - 1.47746f - 60.0f*(t9 - 0.007197f*t3 + 0.00588f*bias));
    const float scale = fminf(fmaxf(t2*(t9*(t8 - 0.52345f)) + 1.00123f + t10, 0.0f), 1.0f);
    const dfg_outputs result = { scale, bias };
    return result;
}
