# n_dot_v, roughness → scale, bias
# data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
# domain: n_dot_v in [0, 1], roughness in [0, 1]
# cost: 18 cycles on gcn
# error: RMSE 0.00605, max 0.06134 on the search split
#        RMSE 0.00607, max 0.06430 on the validation split
#        scale: RMSE 0.00685, max 0.03938
#        bias: RMSE 0.00512, max 0.06134
# finite on every sample of both splits
# t0 = roughness - 0.41*n_dot_v; t1 = max(t0, 0.05); bias = exp2((t1 - 0.36*n_dot_v)*(-1 - t1*(13.3 - 10.3*t0)) - 0.01 - n_dot_v*(7.8*n_dot_v + 6.66)); t2 = n_dot_v*(roughness*t1 - 0.019); t3 = 0.884 - 0.96*t2; scale = t3*(t3 + bias*(-22.4*t2 - 1.178)) + 0.2
import numpy as np


def dfg(n_dot_v, roughness):
    t0 = roughness - 0.41*n_dot_v
    t1 = np.maximum(t0, 0.05)
    t2 = (t1 - 0.36*n_dot_v)*(-1.0 - t1*(13.3 - 10.3*t0)) - 0.01
    bias = np.exp2(t2 - n_dot_v*(7.8*n_dot_v + 6.66))
    t3 = n_dot_v*(roughness*t1 - 0.019)
    t4 = 0.884 - 0.96*t3
    scale = t4*(t4 + bias*(-22.4*t3 - 1.178)) + 0.2
    return scale, bias
