"""Operon on a table: `operon.py TABLE.csv SECONDS SEED`. The last column is the target.

One thread; error and length are both objectives (NSGA-II). Prints the front, a formula a line, over
`x0`, `x1`, …. Settings are the defaults of its estimator but for the operators, the length, and
ten Levenberg-Marquardt steps for each individual.
"""
import sys

import numpy as np
from pyoperon.sklearn import SymbolicRegressor


def main():
    path, seconds, seed = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    inputs = table[:, :-1]
    regressor = SymbolicRegressor(
        allowed_symbols="add,sub,mul,div,fmin,fmax,exp,log,sqrt,square,constant,variable",
        objectives=["mse", "length"],
        optimizer_iterations=10,
        max_length=40,
        n_threads=1,
        generations=10**9,
        max_evaluations=10**12,
        max_time=seconds,
        random_state=seed,
    )
    regressor.fit(inputs, table[:, -1])
    names = [f"x{i}" for i in range(inputs.shape[1])]
    for member in regressor.pareto_front_:
        print(regressor.get_model_string(member["tree"], 9, names))


if __name__ == "__main__":
    main()
