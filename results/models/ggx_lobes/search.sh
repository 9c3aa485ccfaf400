#!/usr/bin/env bash
# Searches the four parameters end to end, by a template that is the model, for two minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
lgp search datasets/ggx_response.bin --template "$(cat results/models/ggx_lobes/template.txt)" \
    --cost-of holes --max-cost 24 --time 2m --out runs/ggx_lobes --force \
    --guess 'middle(v, r) = (r^2 - 1)*(0.5*v + 1.304) + 1.303
        width(v, r) = 3.04 - 2.6*max(max(r, 0.6), abs(0.82 - 1.95*v))
        bandwidth(v, r) = (t0 = (r - 1.15*v)*saturate(r + 0.32*v); t1 = v + t0; v + (16.3*t1 - 14.2)*(t1 - 0.667*saturate(t0 + 0.79)))
        height(v, r) = 0.73*r - 5.946 - 0.97*abs(0.68 - v - 2.93*saturate(r^2 - 0.45))'
