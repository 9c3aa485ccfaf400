# n_dot_v, roughness → scale, bias
# data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
# domain: n_dot_v in [0, 1], roughness in [0, 1]
# cost: 15 cycles on gcn
# error: RMSE 0.00812, max 0.10130 on the search split
#        RMSE 0.00816, max 0.11971 on the validation split
#        scale: RMSE 0.00933, max 0.06978
#        bias: RMSE 0.00669, max 0.10130
# finite on every sample of both splits
# t0 = 1.3*roughness - 0.1; t1 = max(n_dot_v, t0); t2 = 3*t1 - t0; t3 = n_dot_v*(3.8*t2 - 16.4) + 1.06; t4 = (0.0671 - 0.0288*t1)*(t3 - 18.33*t1) + 0.8985; bias = t4^2; scale = (t0*(t2 + (n_dot_v - 1.9*roughness)*t3) + 1.55)*(bias*(0.29*n_dot_v - 0.705) - 0.0713) + 1.1125
import numpy as np


def dfg(n_dot_v, roughness):
    t0 = 1.3*roughness - 0.1
    t1 = np.maximum(n_dot_v, t0)
    t2 = 3.0*t1 - t0
    t3 = n_dot_v*(3.8*t2 - 16.4) + 1.06
    t4 = (0.0671 - 0.0288*t1)*(t3 - 18.33*t1) + 0.8985
    bias = t4*t4
    t5 = t0*(t2 + (n_dot_v - 1.9*roughness)*t3) + 1.55
    scale = t5*(bias*(0.29*n_dot_v - 0.705) - 0.0713) + 1.1125
    return scale, bias
