// n_dot_v, roughness -> bias, total
// data: dfg (d9bba53fa1b19ffd), seed 1, lgp 0.1.0
// derived: total = scale + bias
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 10 cycles, 3 registers on gcn
// error: RMSE 0.00922, max 0.06101 on the search split
//        RMSE 0.00928, max 0.07285 on the validation split
//        bias: RMSE 0.00582, max 0.04273
//        total: RMSE 0.01167, max 0.06101
// finite: proved
// range: proved
// formula: t0 = saturate(roughness + n_dot_v*(0.6*n_dot_v - 1.13)); total = saturate(n_dot_v*((roughness + 1.5*t0)*(0.28*n_dot_v - 0.8) + 0.23) + 0.952); t1 = 0.97 - 0.92*t0 - 1.74*n_dot_v; bias = saturate(t1*saturate(t1^2 + 0.096) + 0.023)
// as it is called here: 12 cycles on gcn
// names: NdotV = n_dot_v
// names: perceptual_roughness = roughness
// let: return.x = max(total - bias, 0)
// let: return.y = bias
// call: F_AB(perceptual_roughness, NdotV)
// names: return_x = return.x
// names: return_y = return.y
// after Bevy 0.19 leave out the next line
#define_import_path F_AB

fn F_AB(perceptual_roughness: f32, NdotV: f32) -> vec2<f32> {
    let t0 = saturate(perceptual_roughness + NdotV*(0.6*NdotV - 1.13));
    let t1 = NdotV*((perceptual_roughness + 1.5*t0)*(0.28*NdotV - 0.8) + 0.23);
    let t2 = 0.97 - 0.92*t0 - 1.74*NdotV;
    let return_y = saturate(t2*saturate(t2*t2 + 0.096) + 0.023);
    let return_x = max(saturate(t1 + 0.952) - return_y, 0.0);
    return vec2<f32>(return_x, return_y);
}
