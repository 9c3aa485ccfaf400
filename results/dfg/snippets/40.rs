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
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = f32::clamp(1.02 - 0.6*roughness + 0.46*n_dot_v, 0.0, 1.0) - 1.3*n_dot_v;
    let t1 = roughness*(43.0 - 46.0*n_dot_v) + 9.6;
    let t2 = n_dot_v + 5.7*roughness;
    let t3 = t2 + 1.2;
    let t4 = roughness*(0.5296*t3 - 2.4827) + 0.25722 - 0.302*n_dot_v;
    let t5 = f32::clamp(0.902*roughness + n_dot_v*(0.27 - 0.19*n_dot_v), 0.0, 1.0);
    let t6 = t4 - f32::min(roughness, t5)*(3.04*roughness - 1.6);
    let bias = t6*t6*(t0*(t0*(t1 - 0.87*(roughness*t1 - 3.4)) + 2.03) + 0.183);
    let t7 = 15.76 - 200.0*((roughness - 0.4538*n_dot_v)*(n_dot_v*roughness + 0.018));
    let t8 = t7*(8e-5 - 0.004777*t0 - 0.00387*n_dot_v);
    let t9 = t8 + 0.0631;
    let t10 = t9 + t3*(0.00144*bias - 0.00971);
    let t11 = t2*((t8 - 0.7066)*(t9 - 0.01212*roughness)) + 1.01358;
    let scale = t11 + bias*(t4 - 1.8498 - 41.228*(t10 + 0.00704*bias)) + 0.5871*t10;
    (scale, bias)
}
