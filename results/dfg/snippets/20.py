# n_dot_v, roughness → scale, bias
# data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
# domain: n_dot_v in [0, 1], roughness in [0, 1]
# cost: 19 cycles on gcn
# error: RMSE 0.00580, max 0.05062 on the search split
#        RMSE 0.00584, max 0.06108 on the validation split
#        scale: RMSE 0.00675, max 0.04195
#        bias: RMSE 0.00466, max 0.05062
# finite on every sample of both splits
# t0 = max(roughness - 0.26*n_dot_v, 0.04); t1 = t0 - 0.8*n_dot_v; bias = exp2(t1*(-1.1 - t0*(12.6 - 10*t1)) - 0.025 - n_dot_v*(9*n_dot_v + 7.03)); t2 = n_dot_v*(t0^2 - 0.019); t3 = 0.861 - 1.14*t2; scale = t3*(min(t3, 0.8425) + bias*(-31*t2 - 1.213)) + 0.2572
import numpy as np


def dfg(n_dot_v, roughness):
    t0 = np.maximum(roughness - 0.26*n_dot_v, 0.04)
    t1 = t0 - 0.8*n_dot_v
    t2 = t1*(-1.1 - t0*(12.6 - 10.0*t1)) - 0.025 - n_dot_v*(9.0*n_dot_v + 7.03)
    bias = np.exp2(t2)
    t3 = n_dot_v*(t0*t0 - 0.019)
    t4 = 0.861 - 1.14*t3
    scale = t4*(np.minimum(t4, 0.8425) + bias*(-31.0*t3 - 1.213)) + 0.2572
    return scale, bias
