// n_dot_v, roughness -> bias, total
// data: dfg (d9bba53fa1b19ffd), seed 1, lgp 0.1.0
// derived: total = scale + bias
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 44 cycles, 7 registers on gcn
// error: RMSE 0.00227, max 0.02845 on the search split
//        RMSE 0.00270, max 0.09593 on the validation split
//        bias: RMSE 0.00202, max 0.02465
//        total: RMSE 0.00250, max 0.02845
// finite: proved
// range: proved
// formula: t0 = 0.5 - 2*roughness; t1 = 0.9*n_dot_v; t2 = saturate(n_dot_v + (1.31 - 1.5*roughness)) + n_dot_v*(3.26*(roughness - 0.4*n_dot_v) - 2.55); t3 = t2 - 0.126; t4 = saturate(n_dot_v*(t1 - 0.66) - (roughness*t3 + (0.198*t3 - 0.247 - t2))); t5 = n_dot_v*t4; t6 = t4 - 0.755*t5; t7 = t4 - 0.61*t5; t8 = t6*(t7 + 0.14*t0); t9 = t4*(18.4 - 98*(t4*t7)) - 15.3; t10 = t9*(t8 + 0.0111*t2) - 1.302; t11 = t10*(0.03094*roughness + 0.00239) + 1.00383; total = saturate(roughness*(t1 + (roughness*t10 + (0.2777*t2 - 0.0942)))*(1.293*n_dot_v + (0.00141*t9 + 0.004)) + (0.296*t8 + t11)); t12 = saturate(0.765*n_dot_v + 0.7768 + saturate(t0 + 1.44*(n_dot_v + 0.5))*(0.2024*t11 + 0.1077)*abs(t6) - 0.494*roughness) - 1.2804*n_dot_v; bias = saturate(saturate(t12*(t12^2 + 0.025) + 0.00977)*(0.94836 - n_dot_v))
// as it is called here: 45 cycles on gcn
// names: NdotV = n_dot_v
// names: perceptualRoughness = roughness
// let: return.x = bias
// let: return.y = max(total, bias)
// let: return.z = 0
// call: getBRDFLookup(NdotV, perceptualRoughness)
// names: return_x = return.x
// names: return_y = return.y
// names: return_z = return.z
// in a shader: #include<getBRDFLookup>
import { ShaderStore } from "@babylonjs/core/Engines/shaderStore";

ShaderStore.IncludesShadersStore["getBRDFLookup"] = `
vec3 getBRDFLookup(float NdotV, float perceptualRoughness) {
    float t0 = 0.5 - 2.0*perceptualRoughness;
    float t1 = 0.9*NdotV;
    float t2 = clamp(NdotV + (1.31 - 1.5*perceptualRoughness), 0.0, 1.0);
    float t3 = t2 + NdotV*(3.26*(perceptualRoughness - 0.4*NdotV) - 2.55);
    float t4 = t3 - 0.126;
    float t5 = NdotV*(t1 - 0.66) - (perceptualRoughness*t4 + (0.198*t4 - 0.247 - t3));
    float t6 = clamp(t5, 0.0, 1.0);
    float t7 = NdotV*t6;
    float t8 = t6 - 0.755*t7;
    float t9 = t6 - 0.61*t7;
    float t10 = t8*(t9 + 0.14*t0);
    float t11 = t6*(18.4 - 98.0*(t6*t9)) - 15.3;
    float t12 = t11*(t10 + 0.0111*t3) - 1.302;
    float t13 = t12*(0.03094*perceptualRoughness + 0.00239) + 1.00383;
    float t14 = t1 + (perceptualRoughness*t12 + (0.2777*t3 - 0.0942));
    float t15 = perceptualRoughness*t14*(1.293*NdotV + (0.00141*t11 + 0.004));
    float t16 = clamp(t0 + 1.44*(NdotV + 0.5), 0.0, 1.0)*(0.2024*t13 + 0.1077)*abs(t8);
    float t17 = clamp(0.765*NdotV + 0.7768 + t16 - 0.494*perceptualRoughness, 0.0, 1.0);
    float t18 = t17 - 1.2804*NdotV;
    float t19 = clamp(t18*(t18*t18 + 0.025) + 0.00977, 0.0, 1.0)*(0.94836 - NdotV);
    float return_x = clamp(t19, 0.0, 1.0);
    float return_y = max(clamp(t15 + (0.296*t10 + t13), 0.0, 1.0), return_x);
    float return_z = 0.0;
    return vec3(return_x, return_y, return_z);
}
`;

ShaderStore.IncludesShadersStoreWGSL["getBRDFLookup"] = `
fn getBRDFLookup(NdotV: f32, perceptualRoughness: f32) -> vec3<f32> {
    let t0 = 0.5 - 2.0*perceptualRoughness;
    let t1 = 0.9*NdotV;
    let t2 = NdotV*(3.26*(perceptualRoughness - 0.4*NdotV) - 2.55);
    let t3 = saturate(NdotV + (1.31 - 1.5*perceptualRoughness)) + t2;
    let t4 = t3 - 0.126;
    let t5 = NdotV*(t1 - 0.66) - (perceptualRoughness*t4 + (0.198*t4 - 0.247 - t3));
    let t6 = saturate(t5);
    let t7 = NdotV*t6;
    let t8 = t6 - 0.755*t7;
    let t9 = t6 - 0.61*t7;
    let t10 = t8*(t9 + 0.14*t0);
    let t11 = t6*(18.4 - 98.0*(t6*t9)) - 15.3;
    let t12 = t11*(t10 + 0.0111*t3) - 1.302;
    let t13 = t12*(0.03094*perceptualRoughness + 0.00239) + 1.00383;
    let t14 = t1 + (perceptualRoughness*t12 + (0.2777*t3 - 0.0942));
    let t15 = perceptualRoughness*t14*(1.293*NdotV + (0.00141*t11 + 0.004));
    let t16 = saturate(t0 + 1.44*(NdotV + 0.5))*(0.2024*t13 + 0.1077)*abs(t8);
    let t17 = saturate(0.765*NdotV + 0.7768 + t16 - 0.494*perceptualRoughness);
    let t18 = t17 - 1.2804*NdotV;
    let return_x = saturate(saturate(t18*(t18*t18 + 0.025) + 0.00977)*(0.94836 - NdotV));
    let return_y = max(saturate(t15 + (0.296*t10 + t13)), return_x);
    let return_z = 0.0;
    return vec3<f32>(return_x, return_y, return_z);
}
`;
