"""scipy's minimisers without derivatives on the functions of results/fit, one line a run.

    python3 benches/peers/minimisers.py PROGRAM      wants `pip install scipy`

PROGRAM is the example `minimisers`: it has the functions, and answers each point with its value.
"""

import csv
import json
import math
import struct
import subprocess
import sys

import numpy
from scipy import optimize

EVALUATIONS = 20_000
# Each evaluation is a message to another process.
SEEDS = range(1, 21)


class Spent(Exception):
    pass


class Recorder:
    """A function that counts its evaluations, and when it meets the minimum."""

    def __init__(self, server, target):
        self.server, self.target = server, target
        self.count, self.best, self.reached = 0, math.inf, ""

    def __call__(self, x):
        if self.count >= EVALUATIONS:
            raise Spent
        self.server.stdin.write(struct.pack(f"<{len(x)}d", *x))
        self.server.stdin.flush()
        (value,) = struct.unpack("<d", self.server.stdout.read(8))
        self.count += 1
        self.best = min(self.best, value)
        if self.reached == "" and value <= self.target:
            self.reached = self.count
        return value


def evolution(f, ranges, seed):
    optimize.differential_evolution(f, ranges, rng=seed)


def annealing(f, ranges, seed):
    optimize.dual_annealing(f, ranges, rng=seed, maxfun=EVALUATIONS)


def simplices(f, ranges, seed):
    random = numpy.random.default_rng(seed)
    low, high = numpy.array(ranges).T
    while True:
        start = random.uniform(low, high)
        optimize.minimize(f, start, method="Nelder-Mead", bounds=ranges, options=simplex_options(start))


def simplex_options(start):
    return {"maxfev": EVALUATIONS, "maxiter": EVALUATIONS, "xatol": 1e-8, "fatol": 1e-12}


def runs(problem, server):
    suite, name, target = problem["suite"], problem["name"], problem["value"]

    def run(method, seed, minimise):
        f = Recorder(server, target)
        try:
            minimise(f)
        except Spent:
            pass
        return [suite, name, method, seed, f.reached, f.count, repr(f.best)]

    if suite == "multimodal":
        for seed in SEEDS:
            for name_of, minimise in [
                ("scipy_de", evolution),
                ("scipy_da", annealing),
                ("scipy_nm", simplices),
            ]:
                yield run(name_of, seed, lambda f: minimise(f, problem["ranges"], seed))
    else:
        for seed, start in enumerate(problem["starts"]):
            options = simplex_options(start)
            yield run(
                "scipy_nm",
                seed,
                lambda f: optimize.minimize(f, start, method="Nelder-Mead", options=options),
            )


def main(program):
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["suite", "problem", "method", "seed", "reached", "evaluations", "best"])
    listed = subprocess.run([program, "list"], check=True, capture_output=True, text=True).stdout
    for line in listed.splitlines():
        problem = json.loads(line)
        command = [program, "serve", problem["name"]]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as server:
            table.writerows(runs(problem, server))
            server.stdin.close()
        sys.stdout.flush()


if __name__ == "__main__":
    main(sys.argv[1])
