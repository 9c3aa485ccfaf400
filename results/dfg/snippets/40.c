// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 40 cycles on gcn
// error: RMSE 0.00261, max 0.03045 on the search split
//        RMSE 0.00275, max 0.07263 on the validation split
//        scale: RMSE 0.00286, max 0.02759
//        bias: RMSE 0.00234, max 0.03045
// finite on every sample of both splits
// t0 = saturate(1.02 - 0.6*roughness + 0.46*n_dot_v) - 1.3*n_dot_v; t1 = roughness*(43 - 46*n_dot_v) + 9.6; t2 = n_dot_v + 5.7*roughness; t3 = t2 + 1.2; t4 = roughness*(0.5296*t3 - 2.4827) + 0.25722 - 0.302*n_dot_v; t5 = t4 - min(roughness, saturate(0.902*roughness + n_dot_v*(0.27 - 0.19*n_dot_v)))*(3.04*roughness - 1.6); bias = t5^2*(t0*(t0*(t1 - 0.87*(roughness*t1 - 3.4)) + 2.03) + 0.183); t6 = (15.76 - 200*((roughness - 0.4538*n_dot_v)*(n_dot_v*roughness + 0.018)))*(8e-5 - 0.004777*t0 - 0.00387*n_dot_v); t7 = t6 + 0.0631; t8 = t7 + t3*(0.00144*bias - 0.00971); scale = t2*((t6 - 0.7066)*(t7 - 0.01212*roughness)) + 1.01358 + bias*(t4 - 1.8498 - 41.228*(t8 + 0.00704*bias)) + 0.5871*t8
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = fminf(fmaxf(1.02f - 0.6f*roughness + 0.46f*n_dot_v, 0.0f), 1.0f);
    const float t1 = t0 - 1.3f*n_dot_v;
    const float t2 = roughness*(43.0f - 46.0f*n_dot_v) + 9.6f;
    const float t3 = n_dot_v + 5.7f*roughness;
    const float t4 = t3 + 1.2f;
    const float t5 = roughness*(0.5296f*t4 - 2.4827f) + 0.25722f - 0.302f*n_dot_v;
    const float t6 = 0.902f*roughness + n_dot_v*(0.27f - 0.19f*n_dot_v);
    const float t7 = fminf(roughness, fminf(fmaxf(t6, 0.0f), 1.0f))*(3.04f*roughness - 1.6f);
    const float t8 = t5 - t7;
    const float bias = t8*t8*(t1*(t1*(t2 - 0.87f*(roughness*t2 - 3.4f)) + 2.03f) + 0.183f);
    const float t9 = 200.0f*((roughness - 0.4538f*n_dot_v)*(n_dot_v*roughness + 0.018f));
    const float t10 = (15.76f - t9)*(8e-5f - 0.004777f*t1 - 0.00387f*n_dot_v);
    const float t11 = t10 + 0.0631f;
    const float t12 = t11 + t4*(0.00144f*bias - 0.00971f);
    const float t13 = t3*((t10 - 0.7066f)*(t11 - 0.01212f*roughness)) + 1.01358f;
    const float scale = t13 + bias*(t5 - 1.8498f - 41.228f*(t12 + 0.00704f*bias)) + 0.5871f*t12;
    const dfg_outputs result = { scale, bias };
    return result;
}
