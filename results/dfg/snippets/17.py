# n_dot_v, roughness → scale, bias
# data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
# domain: n_dot_v in [0, 1], roughness in [0, 1]
# cost: 16 cycles on gcn
# error: RMSE 0.00775, max 0.09439 on the search split
#        RMSE 0.00777, max 0.09059 on the validation split
#        scale: RMSE 0.00879, max 0.04848
#        bias: RMSE 0.00655, max 0.09439
# finite on every sample of both splits
# t0 = 1.3*roughness - 0.09; t1 = max(n_dot_v, t0); t2 = 2.8*t1 - t0; t3 = n_dot_v*(t2 - 3.6); t4 = (0.335 - 0.134*t1)*(t3 - 3.66*t1) + 0.9784; bias = t4^2; scale = (t0*(t0 + (n_dot_v - 1.3*roughness)*(0.9*t3 + min(t2, 0.85))) + 0.35)*(-2.96*bias - 0.422) + 1.1558
import numpy as np


def dfg(n_dot_v, roughness):
    t0 = 1.3*roughness
    t1 = t0 - 0.09
    t2 = np.maximum(n_dot_v, t1)
    t3 = 2.8*t2 - t1
    t4 = n_dot_v*(t3 - 3.6)
    t5 = (0.335 - 0.134*t2)*(t4 - 3.66*t2) + 0.9784
    bias = t5*t5
    t6 = t1*(t1 + (n_dot_v - t0)*(0.9*t4 + np.minimum(t3, 0.85))) + 0.35
    scale = t6*(-2.96*bias - 0.422) + 1.1558
    return scale, bias
