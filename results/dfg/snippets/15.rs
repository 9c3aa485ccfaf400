// n_dot_v, roughness → scale, bias
// data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
// domain: n_dot_v in [0, 1], roughness in [0, 1]
// cost: 14 cycles on gcn
// error: RMSE 0.00848, max 0.11930 on the search split
//        RMSE 0.00851, max 0.11079 on the validation split
//        scale: RMSE 0.00997, max 0.06053
//        bias: RMSE 0.00667, max 0.11930
// finite on every sample of both splits
// t0 = 1.44*roughness - 0.11; t1 = max(n_dot_v, t0); t2 = n_dot_v*(t1*(6.1 - 2.4*roughness) - 7.5) + 0.59; t3 = (0.1822 - 0.069*t1)*(t2 - 6.04*t1) + 0.8745; bias = t3^2; scale = (t0*(t1 + t2*(n_dot_v - 1.8*roughness)) + 0.86)*(-1.236*bias - 0.1812) + 1.1625
pub fn dfg(n_dot_v: f32, roughness: f32) -> (f32, f32) {
    let t0 = 1.44*roughness - 0.11;
    let t1 = f32::max(n_dot_v, t0);
    let t2 = n_dot_v*(t1*(6.1 - 2.4*roughness) - 7.5) + 0.59;
    let t3 = (0.1822 - 0.069*t1)*(t2 - 6.04*t1) + 0.8745;
    let bias = t3*t3;
    let t4 = (t0*(t1 + t2*(n_dot_v - 1.8*roughness)) + 0.86)*(-1.236*bias - 0.1812);
    let scale = t4 + 1.1625;
    (scale, bias)
}
