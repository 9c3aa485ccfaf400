// n_dot_v, roughness -> bias, total
// data: dfg (d9bba53fa1b19ffd), seed 1, lgp 0.1.0
// derived: total = scale + bias
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 20 cycles, 6 registers on gcn
// error: RMSE 0.00480, max 0.05161 on the search split
//        RMSE 0.00488, max 0.08961 on the validation split
//        bias: RMSE 0.00468, max 0.05161
//        total: RMSE 0.00493, max 0.03790
// finite: proved
// range: proved
// formula: t0 = saturate(0.75*n_dot_v + 1.04 - 0.92*roughness); t1 = t0 - 1.6*n_dot_v; t2 = t1 + 0.15*t0; t3 = t2^2 + 0.2; t4 = t1*t3; t5 = t4 + 0.105; bias = saturate(t5 - 0.432*t3); t6 = n_dot_v - 4.86*t5; t7 = 1.626*roughness - 0.11; total = saturate((((0.156*n_dot_v - 0.374)*t6 + t7)*(n_dot_v*(t4 + 0.254) - roughness) + 0.1236)*(n_dot_v + 0.0653*t7 - min(t6, -0.516)*(t2*(n_dot_v + 0.1745) - 0.1807)) + 0.94)
// as it is called here: 22 cycles on gcn
// names: dotNV = n_dot_v
// let: return.x = max(total - bias, 0)
// let: return.y = bias
// call: dfg(dotNV, roughness)
// names: return_x = return.x
// names: return_y = return.y
export const dfg = /* glsl */`
vec2 dfg(float dotNV, float roughness) {
    float t0 = clamp(0.75*dotNV + 1.04 - 0.92*roughness, 0.0, 1.0);
    float t1 = t0 - 1.6*dotNV;
    float t2 = t1 + 0.15*t0;
    float t3 = t2*t2 + 0.2;
    float t4 = t1*t3;
    float t5 = t4 + 0.105;
    float return_y = clamp(t5 - 0.432*t3, 0.0, 1.0);
    float t6 = dotNV - 4.86*t5;
    float t7 = 1.626*roughness - 0.11;
    float t8 = ((0.156*dotNV - 0.374)*t6 + t7)*(dotNV*(t4 + 0.254) - roughness);
    float t9 = dotNV + 0.0653*t7 - min(t6, -0.516)*(t2*(dotNV + 0.1745) - 0.1807);
    float return_x = max(clamp((t8 + 0.1236)*t9 + 0.94, 0.0, 1.0) - return_y, 0.0);
    return vec2(return_x, return_y);
}
`;
