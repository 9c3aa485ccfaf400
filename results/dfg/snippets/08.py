# n_dot_v, roughness → scale, bias
# data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
# domain: n_dot_v in [0, 1], roughness in [0, 1]
# cost: 7 cycles on gcn
# error: RMSE 0.02420, max 0.14226 on the search split
#        RMSE 0.02416, max 0.15339 on the validation split
#        scale: RMSE 0.02847, max 0.14226
#        bias: RMSE 0.01898, max 0.13199
# finite on every sample of both splits
# t0 = saturate(saturate(roughness*(3.5*n_dot_v - 1.42) + 1.09) - 2.1*n_dot_v); bias = t0^2 + 0.009; scale = saturate(n_dot_v*(0.35 - roughness^2) + 0.81) - 0.73*bias
import numpy as np


def dfg(n_dot_v, roughness):
    t0 = np.clip(roughness*(3.5*n_dot_v - 1.42) + 1.09, 0.0, 1.0) - 2.1*n_dot_v
    t1 = np.clip(t0, 0.0, 1.0)
    bias = t1*t1 + 0.009
    t2 = np.clip(n_dot_v*(0.35 - roughness*roughness) + 0.81, 0.0, 1.0)
    scale = t2 - 0.73*bias
    return scale, bias
