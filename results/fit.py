"""Minimisers beside argmin's and scipy's on functions whose minima are published: how many runs reach the minimum within so
many evaluations. Writes fit/reached.csv and the tables in fit/README.md. All seeds are fixed, no time is measured.

    python3 results/fit.py [CSV...]      wants `pip install scipy`; CSV: runs made before, instead of making them
"""

import csv
import statistics
import subprocess
import sys
from collections import defaultdict

from tables import RESULTS, replace

BENCHES = RESULTS.parent / "benches"
BUDGETS = [1000, 5000, 20000]
FIELDS = ["suite", "problem", "method", "runs", *[f"within_{budget}" for budget in BUDGETS]]
FIELDS += ["median_evaluations", "median_best"]
NAMES = {
    "lgp_de_nm": "`lgp`: global (DE → Nelder–Mead, in rounds)",
    "lgp_de": "`lgp`: DE/rand/1/bin alone",
    "lgp_de_best": "`lgp`: DE/best/1/bin alone",
    "lgp_nm": "`lgp`: Nelder–Mead with restarts",
    "argmin_nm": "argmin: Nelder–Mead",
    "argmin_pso": "argmin: particle swarm",
    "scipy_de": "scipy: differential_evolution (with L-BFGS-B)",
    "scipy_da": "scipy: dual_annealing (with L-BFGS-B)",
    "scipy_nm": "scipy: Nelder–Mead",
}
SHORT = {
    "lgp_de_nm": "lgp global",
    "lgp_de": "lgp DE/rand",
    "lgp_de_best": "lgp DE/best",
    "lgp_nm": "lgp NM",
    "argmin_nm": "argmin NM",
    "argmin_pso": "argmin PSO",
    "scipy_de": "scipy DE",
    "scipy_da": "scipy annealing",
    "scipy_nm": "scipy NM",
}


def output(*command):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout


def runs(files):
    if files:
        texts = [open(file).read() for file in files]
    else:
        output("cargo", "build", "--release", "--example", "minimisers")
        program = RESULTS.parent / "target/release/examples/minimisers"
        argmin = BENCHES / "peers/argmin/Cargo.toml"
        texts = [
            output(program),
            output("cargo", "run", "--release", "--manifest-path", argmin),
            output(sys.executable, BENCHES / "peers/minimisers.py", program),
        ]
    return [run for text in texts for run in csv.DictReader(text.splitlines())]


def summary(runs):
    grouped = defaultdict(list)
    for run in runs:
        grouped[run["suite"], run["problem"], run["method"]].append(run)
    for (suite, problem, method), group in grouped.items():
        row = {"suite": suite, "problem": problem, "method": method, "runs": len(group)}
        for budget in BUDGETS:
            reached = sum(bool(run["reached"]) and int(run["reached"]) <= budget for run in group)
            row[f"within_{budget}"] = f"{reached / len(group):.2f}"
        row["median_evaluations"] = round(statistics.median(int(run["evaluations"]) for run in group))
        row["median_best"] = f"{statistics.median(float(run['best']) for run in group):.3e}"
        yield row


def share(text):
    return f"{float(text):.2f}".removeprefix("0")


def tables(rows, suite):
    rows = [row for row in rows if row["suite"] == suite]
    methods = [method for method in NAMES if any(row["method"] == method for row in rows)]
    problems = list(dict.fromkeys(row["problem"] for row in rows))
    found = {(row["problem"], row["method"]): row for row in rows}
    whole = ["| minimiser | " + " | ".join(f"within {budget:,}" for budget in BUDGETS) + " |", "|---|---|---|---|"]
    for method in methods:
        means = [
            statistics.mean(float(found[problem, method][f"within_{budget}"]) for problem in problems) for budget in BUDGETS
        ]
        whole.append(f"| {NAMES[method]} | " + " | ".join(share(mean) for mean in means) + " |")
    each = ["| function | " + " | ".join(SHORT[method] for method in methods) + " |", "|---" * (len(methods) + 1) + "|"]
    for problem in problems:
        cells = [
            " ".join(share(found[problem, method][f"within_{budget}"]) for budget in BUDGETS[1:]) for method in methods
        ]
        each.append(f"| `{problem}` | " + " | ".join(cells) + " |")
    page = RESULTS / "fit/README.md"
    replace(page, suite, whole)
    replace(page, f"each of {suite}", each)


def main(files):
    rows = list(summary(runs(files)))
    with open(RESULTS / "fit/reached.csv", "w", newline="") as file:
        table = csv.DictWriter(file, FIELDS, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    for suite in ["multimodal", "mgh"]:
        tables(rows, suite)


if __name__ == "__main__":
    main(sys.argv[1:])
