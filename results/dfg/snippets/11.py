# n_dot_v, roughness → scale, bias
# data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
# domain: n_dot_v in [0, 1], roughness in [0, 1]
# cost: 10 cycles on gcn
# error: RMSE 0.01449, max 0.09732 on the search split
#        RMSE 0.01450, max 0.10769 on the validation split
#        scale: RMSE 0.01687, max 0.09732
#        bias: RMSE 0.01163, max 0.05956
# finite on every sample of both splits
# t0 = 0.3*n_dot_v - roughness; t1 = 0.0229 - 0.026*max(n_dot_v, roughness); t2 = t1*(61.7*n_dot_v - 41.7) - 0.029; bias = t1 + t2^2; t3 = t0*(n_dot_v*t0 - 0.08) - 0.889; scale = t3*(t3 + 1.224*bias) + 0.2202
import numpy as np


def dfg(n_dot_v, roughness):
    t0 = 0.3*n_dot_v - roughness
    t1 = 0.0229 - 0.026*np.maximum(n_dot_v, roughness)
    t2 = t1*(61.7*n_dot_v - 41.7) - 0.029
    bias = t1 + t2*t2
    t3 = t0*(n_dot_v*t0 - 0.08) - 0.889
    scale = t3*(t3 + 1.224*bias) + 0.2202
    return scale, bias
