# n_dot_v, roughness → scale, bias
# data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
# domain: n_dot_v in [0, 1], roughness in [0, 1]
# cost: 21 cycles on gcn
# error: RMSE 0.00553, max 0.05191 on the search split
#        RMSE 0.00559, max 0.06643 on the validation split
#        scale: RMSE 0.00646, max 0.04119
#        bias: RMSE 0.00440, max 0.05191
# finite on every sample of both splits
# t0 = roughness - 0.74*n_dot_v; t1 = roughness - 0.25*n_dot_v; bias = exp2(min(roughness + t0*(-1.5 - (11.5 - 9*t0)*t1), -0.05) - n_dot_v*(7*n_dot_v + 6.82) - t0); t2 = n_dot_v*(t1*max(t1, 0.04) - 0.023); t3 = 0.872 - 1.08*t2; scale = t3*(min(t3, 0.854) - bias*(28.5*t2 + 1.2)) + 0.2336
import numpy as np


def dfg(n_dot_v, roughness):
    t0 = roughness - 0.74*n_dot_v
    t1 = roughness - 0.25*n_dot_v
    t2 = np.minimum(roughness + t0*(-1.5 - (11.5 - 9.0*t0)*t1), -0.05)
    bias = np.exp2(t2 - n_dot_v*(7.0*n_dot_v + 6.82) - t0)
    t3 = n_dot_v*(t1*np.maximum(t1, 0.04) - 0.023)
    t4 = 0.872 - 1.08*t3
    scale = t4*(np.minimum(t4, 0.854) - bias*(28.5*t3 + 1.2)) + 0.2336
    return scale, bias
