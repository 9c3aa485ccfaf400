"""Templates beside free searches of equal time and budget, five seeds each: what is found of functions whose structure is
known. Writes templates/templates.csv and the table in templates/README.md. Errors are those on grids denser than a search
has seen; of a table, those on its validation rows.

    python3 results/templates.py [SECONDS [PROBLEM...]]      lgp on the PATH; 30 seconds by default
    python3 results/templates.py SECONDS agx=TABLE.csv       a table of r_in, g_in, b_in, r, g, b
"""

import csv
import json
import math
import re
import sys
import tempfile
from pathlib import Path
from statistics import median

from tables import RESULTS, lgp, replace

LOBE = "g = 0.05 + 0.75*r*(1.6 - 0.6*r)/(0.8 + 0.2*r*r); y = (1 - g^2)/pow(1 + g^2 + 2*g*c, 1.5)"
WAVE = "y = sin(3*x*t + x^2) + z*exp2(-3*z)"
TONE = (
    "L(v) = 0.08*log2(1 + 400*v); A = L(0.65*r + 0.25*g + 0.1*b); B = L(0.12*r + 0.78*g + 0.1*b);"
    " C = L(0.08*r + 0.17*g + 0.75*b);"
    " (x, y, z) = (1.3*A - 0.2*B - 0.1*C, -0.1*A + 1.25*B - 0.15*C, -0.05*A - 0.15*B + 1.2*C)"
)
DECODE = "lin = v < 0.04045 ? v/12.92 : pow((v + 0.055)/1.055, 2.4)"
ENCODE = "v = lin < 0.0031308 ? 12.92*lin : 1.055*pow(lin, 1/2.4) - 0.055"


class Problem:
    """A formula whose structure a template knows."""

    def __init__(self, formula, domain, points, dense, template, cycles):
        self.formula, self.domain, self.template, self.cycles = formula, domain, template, cycles
        self.points, self.dense = points, dense

    def data(self, folder):
        made = ["generate", "--formula", self.formula, "--domain", self.domain, "--quiet"]
        for name, points in [("search", self.points), ("dense", self.dense)]:
            lgp(*made, "--points", str(points), "-o", str(folder / f"{name}.bin"))

    def error(self, member, folder):
        return json.loads(lgp("eval", member["formula"], str(folder / "dense.bin"), "--json"))["rmse"]


class Table:
    """A table of a tone map, from elsewhere."""

    def __init__(self, path, template, cycles):
        self.path, self.template, self.cycles = path, template, cycles

    def data(self, folder):
        lgp("import", self.path, "--inputs", "r_in,g_in,b_in", "-o", str(folder / "search.bin"), "--quiet")

    def error(self, member, folder):
        return member["validation"]["rmse"]


PROBLEMS = {
    "henyey_greenstein": Problem(LOBE, "c=-1..1,r=0..1", 24, 200, "y = (1 - g(r)^2)/pow(1 + g(r)^2 + 2*g(r)*c, 1.5)", [22, 24, 27]),
    "sine": Problem(WAVE, "x=0..2,t=0..2,z=0..1", 16, 40, "y = sin(f(x, t)) + g(z)", [10, 13, 20]),
    "tone_map": Problem(TONE, "r=0..4,g=0..4,b=0..4", 14, 40, "(x, y, z) = $N(f($M(r, g, b)))", [33, 36, 60]),
}
AGX = "(r, g, b) = saturate(n(r_in, g_in, b_in))"
SEEDS = range(1, 6)
TABLE = RESULTS / "templates/templates.csv"


def search(data, seconds, seed, most, out, *options):
    limits = ["--time", f"{seconds}s", "--max-cost", str(most), "--threads", "2", "--seed", str(seed)]
    lgp("search", str(data), *limits, "--out", str(out), "--quiet", *options)
    return json.loads(lgp("front", str(out), "--json"))


def chosen(members, cycles):
    """The front's own choice, by the error that it shows."""
    affordable = [member for member in members if member["cost"] <= cycles]
    return affordable[-1] if affordable else None


def rows(name, problem, seconds):
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        problem.data(folder)
        for seed in SEEDS:
            for kind, options in [("free", []), ("template", ["--template", problem.template])]:
                most = problem.cycles[-1]
                members = search(folder / "search.bin", seconds, seed, most, folder / f"{kind}-{seed}", *options)
                for cycles in problem.cycles:
                    member = chosen(members, cycles)
                    error = problem.error(member, folder) if member else float("nan")
                    yield [name, kind, seed, cycles, f"{error:.4e}"]


def renamed(formula, mark):
    """A formula with its intermediate results marked, and `back` for `v`, so that two stand in one text."""
    return re.sub(r"\bt(\d+)\b", rf"{mark}\1", formula).replace("v = ", "back = ")


def pair_rows(seconds, budgets=(9, 10, 12)):
    """The larger of the largest errors of sRGB's decoding and of the round trip: found together, where the encoding makes
    up for the decoding's error, and apart, each in half the time, by the division of the cycles that is best."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        made = ["generate", "--points", "1024", "--quiet", "--domain"]
        lgp(*made, "v=0..1", "--formula", DECODE, "-o", str(folder / "decode.bin"))
        lgp(*made, "lin=0..1", "--formula", ENCODE, "-o", str(folder / "encode.bin"))
        lgp("generate", "--points", "20000", "--quiet", "--domain", "v=0..1", "--formula", f"{DECODE}; back = 1*v", "-o", str(folder / "dense.bin"))

        def errors(formula):
            told = json.loads(lgp("eval", formula, str(folder / "dense.bin"), "--json"))
            return math.inf if told["max_error"] is None else told["max_error"]

        for seed in SEEDS:
            options = ["--loss", "max", "--cost-of", "holes", "--derive", "back = v", "--template", "lin = f(v); back = g(f(v))"]
            together = search(folder / "decode.bin", seconds, seed, budgets[-1], folder / f"pair-{seed}", *options)
            parts = [search(folder / f"{name}.bin", seconds / 2, seed, budgets[-1], folder / f"{name}-{seed}", "--loss", "max") for name in ("decode", "encode")]
            trips = [
                (decode["cost"] + encode["cost"], errors(f"{renamed(decode['formula'], 'd')}; {renamed(encode['formula'], 'e')}"))
                for decode in parts[0]
                for encode in parts[1]
                if decode["cost"] + encode["cost"] <= budgets[-1]
            ]
            for cycles in budgets:
                yield ["pair", "free", seed, cycles, f"{min(back for cost, back in trips if cost <= cycles):.4e}"]
                yield ["pair", "template", seed, cycles, f"{errors(chosen(together, cycles)['formula']):.4e}"]


def table():
    found = {}
    with TABLE.open() as file:
        for problem, kind, _, cycles, error in list(csv.reader(file))[1:]:
            found.setdefault((problem, int(cycles)), {}).setdefault(kind, []).append(float(error))
    lines = ["| function | cycles | free search | template | ratio | template, by seed |", "|---|---|---|---|---|---|"]
    for (problem, cycles), kinds in found.items():
        free, known = median(kinds["free"]), median(kinds["template"])
        seeds = " ".join(f"{error:.1e}" for error in kinds["template"])
        lines.append(f"| `{problem}` | {cycles} | {free:.2e} | **{known:.2e}** | {free / known:.3g} | {seeds} |")
    replace("templates/README.md", "templates", lines)


def main():
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 30
    problems = {}
    for name in sys.argv[2:] or [*PROBLEMS, "pair"]:
        name, _, path = name.partition("=")
        problems[name] = Table(path, AGX, [15, 30, 45]) if path else PROBLEMS.get(name)
    kept = list(csv.reader(TABLE.open()))[1:] if TABLE.exists() else []
    with TABLE.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["function", "search", "seed", "cycles", "error"])
        writer.writerows(row for row in kept if row[0] not in problems)
        for name, problem in problems.items():
            writer.writerows(rows(name, problem, seconds) if problem else pair_rows(seconds))
            file.flush()
    table()


if __name__ == "__main__":
    main()
