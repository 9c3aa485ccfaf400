# n_dot_v, roughness → scale, bias
# data: dfg (7b034b9b6a989aa5), seed 1, lgp 0.1.0
# domain: n_dot_v in [0, 1], roughness in [0, 1]
# cost: 16 cycles on gcn
# error: RMSE 0.00828, max 0.07386 on the search split
#        RMSE 0.00832, max 0.07229 on the validation split
#        scale: RMSE 0.00975, max 0.04498
#        bias: RMSE 0.00647, max 0.07386
# finite on every sample of both splits
# t0 = n_dot_v - 0.9*roughness; t1 = saturate(roughness*(n_dot_v*(-t0 - 0.26) - 0.03) + 1.05 + 0.79*t0); t2 = saturate(t1 - 1.59*(n_dot_v + 0.1*roughness)); bias = t2*((t1*t2 - 0.19)*t2 + 0.1512) + 0.00425; scale = saturate(n_dot_v*(roughness*(0.766*n_dot_v + (t1 - 2.56)) + 0.373) + 0.9675) + bias*(-0.413*roughness - 0.991)
import numpy as np


def dfg(n_dot_v, roughness):
    t0 = n_dot_v - 0.9*roughness
    t1 = roughness*(n_dot_v*(-t0 - 0.26) - 0.03) + 1.05 + 0.79*t0
    t2 = np.clip(t1, 0.0, 1.0)
    t3 = np.clip(t2 - 1.59*(n_dot_v + 0.1*roughness), 0.0, 1.0)
    bias = t3*((t2*t3 - 0.19)*t3 + 0.1512) + 0.00425
    t4 = n_dot_v*(roughness*(0.766*n_dot_v + (t2 - 2.56)) + 0.373) + 0.9675
    scale = np.clip(t4, 0.0, 1.0) + bias*(-0.413*roughness - 0.991)
    return scale, bias
