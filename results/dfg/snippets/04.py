# n_dot_v, roughness → scale, bias
# data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
# domain: n_dot_v in [0, 1], roughness in [0, 1]
# cost: 3 cycles on gcn
# error: RMSE 0.07169, max 0.61787 on the search split
#        RMSE 0.07141, max 0.64583 on the validation split
#        scale: RMSE 0.09299, max 0.61787
#        bias: RMSE 0.04037, max 0.17626
# finite on every sample of both splits
# t0 = 0.82 - 1.1*roughness; scale = saturate(n_dot_v*t0 + 0.65); bias = saturate(t0 - 1.6*n_dot_v)
import numpy as np


def dfg(n_dot_v, roughness):
    t0 = 0.82 - 1.1*roughness
    scale = np.clip(n_dot_v*t0 + 0.65, 0.0, 1.0)
    bias = np.clip(t0 - 1.6*n_dot_v, 0.0, 1.0)
    return scale, bias
