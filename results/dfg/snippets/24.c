// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 28 cycles on gcn
// error: RMSE 0.00498, max 0.08475 on the search split
//        RMSE 0.00500, max 0.08656 on the validation split
//        scale: RMSE 0.00567, max 0.03522
//        bias: RMSE 0.00418, max 0.08475
// finite on every sample of both splits
// t0 = 0.755*(roughness + 0.51*n_dot_v); bias = exp2((-6.3*n_dot_v - 5.73)*max(n_dot_v + 0.05, t0) - t0 + 0.26); scale = min(0.7568 - (exp2(max(n_dot_v, 0.7*roughness - 0.0865)*(1.56*roughness - 5.444) - 7*n_dot_v) - 0.1245)*((roughness - 0.7494)*(-1.853*roughness - 2.463 - 7*min(n_dot_v, t0)) - 0.983), 0.9944)
#include <math.h>

typedef struct {
    float scale;
    float bias;
} dfg_outputs;

dfg_outputs dfg(float n_dot_v, float roughness) {
    const float t0 = 0.755f*(roughness + 0.51f*n_dot_v);
    const float bias = exp2f((-6.3f*n_dot_v - 5.73f)*fmaxf(n_dot_v + 0.05f, t0) - t0 + 0.26f);
    const float t1 = fmaxf(n_dot_v, 0.7f*roughness - 0.0865f)*(1.56f*roughness - 5.444f);
    const float t2 = -1.853f*roughness - 2.463f - 7.0f*fminf(n_dot_v, t0);
    const float t3 = (exp2f(t1 - 7.0f*n_dot_v) - 0.1245f)*((roughness - 0.7494f)*t2 - 0.983f);
    const float scale = fminf(0.7568f - t3, 0.9944f);
    const dfg_outputs result = { scale, bias };
    return result;
}
