"""Samples that follow a search beside a fixed grid: the errors over the whole domain of what is found in equal time, five
seeds each. Writes functions/following.csv and the table in functions/README.md. The errors are those on a far denser grid
than either search has seen, not the integrals that the search ends with.

    python3 results/following.py [SECONDS [PROBLEM...]]      lgp on the PATH; 20 seconds by default
"""

import csv
import json
import math
import sys
import tempfile
from pathlib import Path

from tables import RESULTS, lgp, replace

LOBE = ["--formula", "c = cos(t); a2 = a*a; y = a2*a2/(c*c*(a2 - 1) + 1)^2", "--domain", "t=0..pi/2,a=.01..0.2"]
PROBLEMS = {
    # What is searched, and the dense grid.
    "dfg": (["datasets/dfg.bin"], ["datasets/dfg.ron", "--set", "points=256"]),
    "lobe": (LOBE, [*LOBE, "--points", "1000"]),
}
CYCLES = [4, 6, 8, 10, 12, 16, 20]
SEEDS = range(1, 6)
TABLE = RESULTS / "functions/following.csv"


def searched(problem, kind, seed, seconds, folder):
    out = folder / f"{problem}-{kind}-{seed}"
    options = ["--fixed-samples"] if kind == "grid" else []
    limits = ["--time", f"{seconds}s", "--max-cost", str(CYCLES[-1]), "--threads", "2"]
    lgp("search", *PROBLEMS[problem][0], *limits, "--seed", str(seed), "--out", str(out), "--quiet", *options)
    return json.loads(lgp("front", str(out), "--json"))


def rows(problem, seconds):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        dense = str(folder / "dense.bin")
        lgp("generate", *PROBLEMS[problem][1], "-o", dense, "--quiet")
        for seed in SEEDS:
            for kind in ["grid", "following"]:
                members = searched(problem, kind, seed, seconds, folder)
                for cycles in CYCLES:
                    # The front's own choice, by the error that it shows.
                    chosen = [member for member in members if member["cost"] <= cycles][-1]
                    rmse = json.loads(lgp("eval", chosen["formula"], dense, "--json"))["rmse"]
                    yield [problem, kind, seed, cycles, f"{rmse:.4e}"]


def mean(errors):
    return math.exp(sum(map(math.log, errors)) / len(errors))


def table():
    found = {}
    with TABLE.open() as file:
        for problem, kind, _, cycles, rmse in list(csv.reader(file))[1:]:
            found.setdefault((problem, int(cycles)), {}).setdefault(kind, []).append(float(rmse))
    lines = ["| function | cycles | grid | following | ratio, by seed |", "|---|---|---|---|---|"]
    for (problem, cycles), by_kind in found.items():
        grid, following = by_kind["grid"], by_kind["following"]
        ratios = " ".join(f"{b / a:.2g}" for a, b in zip(grid, following))
        lines.append(f"| `{problem}` | {cycles} | {mean(grid):.2e} | {mean(following):.2e} | **{mean(following) / mean(grid):.2f}** ({ratios}) |")
    replace("functions/README.md", "following", lines)


if __name__ == "__main__":
    seconds = sys.argv[1] if len(sys.argv) > 1 else "20"
    with TABLE.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["function", "samples", "seed", "cycles", "rmse"])
        for problem in sys.argv[2:] or PROBLEMS:
            writer.writerows(rows(problem, seconds))
    table()
