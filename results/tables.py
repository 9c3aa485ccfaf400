"""Writes the tables of results/README.md, results/scenes/README.md, results/functions/README.md and
results/models/materials/README.md, between their marks, by what `lgp` says of the runs."""

import json
import re
import subprocess
import sys
from pathlib import Path

RESULTS = Path(__file__).parent
RUNS = ["dfg", "dfg_paper", "fresnel", "beckmann_g1", "smith_g2", "area_norm", "disney_zh0", "hammon_single", "hammon_multi"]
MATERIALS = [
    "sheen_albedo", "sheen_albedo_materialx", "sheen_volume_albedo", "ltc_sheen", "coat_albedo", "dielectric_albedo", "average_albedo", "average_fresnel",
    "conductor", "blackbody", "blackbody_srgb", "tone_curve", "tone_curve_signal",
]
SCENES = [("materialx_rational", "materialx"), ("ue5_ggx_energy", "ue5")]


def lgp(*arguments):
    done = subprocess.run(["lgp", *arguments], cwd=RESULTS.parent, capture_output=True, text=True, check=True)
    return done.stdout


def short(error):
    return f"{error:.5f}".lstrip("0") if error >= 1e-4 else f"{error:.1e}"


def replace(page, mark, lines):
    path = RESULTS / page
    begin, end = f"<!-- {mark} -->\n", f"<!-- end of {mark} -->"
    before, rest = path.read_text().split(begin)
    path.write_text(before + begin + "\n".join(lines) + "\n" + rest[rest.index(end):])


def front(folder):
    return json.loads(lgp("front", folder, "--json"))


def at(members, cost):
    return min(m["rmse"] for m in members if m["cost"] <= cost + 1e-9)


def matching(members, error):
    return next((m["cost"] for m in members if m["rmse"] <= error), None)


def published(folder):
    """Name, cycles and RMSE of each published formula that `lgp front` lists."""
    lines = lgp("front", folder).splitlines()
    for row, below in zip(lines, lines[1:]):
        if row.split()[:1] == ["*"]:
            yield below.split(":")[0].strip(), float(row.split()[1]), float(row.split()[2])


def gallery():
    beside_published("README.md", RUNS, "results/{0}", "[`{0}`]({0}/front.txt)")


def materials():
    beside_published("models/materials/README.md", MATERIALS, "runs/{0}", "[`{0}`]({0}.png)")


def beside_published(page, runs, folder, cell):
    lines = ["| run | published | its cycles | its RMSE | the front's RMSE there | cycles that match it |", "|---|---|---|---|---|---|"]
    for run in runs:
        members = front(folder.format(run))
        for name, cost, error in sorted(published(folder.format(run)), key=lambda known: known[1:]):
            matched = matching(members, error)
            matched = "none" if matched is None else f"{matched:g}"
            lines.append(f"| {cell.format(run)} | `{name}` | {cost:g} | {short(error)} | {short(at(members, cost))} | {matched} |")
    replace(page, "published", lines)


def scenes():
    whole, satin = front("results/dfg"), front("results/scenes/satin")
    lines = ["| formula for the whole domain | its error | the scene's front | there | the scene's front |", "|---|---|---|---|---|"]
    for cost in (16, 19, 22):
        member = max((m for m in whole if m["cost"] <= cost), key=lambda m: m["cost"])
        there = json.loads(lgp("eval", member["formula"], "datasets/dfg.bin", "--scene", "satin", "--json"))["rmse"]
        cells = []
        for error in (member["rmse"], there):
            matched = matching(satin, error)
            cells += [short(error), "none" if matched is None else f"{matched:g} cycles, {matched / member['cost']:.0%}"]
        lines.append(f"| {member['cost']:g} cycles of [`results/dfg`](../dfg/front.txt) | " + " | ".join(cells) + " |")
    replace("scenes/README.md", "satin", lines)
    cut()


def cut():
    lines = ["| formula | scene | as given | constants fitted | as good as given | twice its error | half its cycles | steps |", "|---|---|---|---|---|---|---|---|"]
    incumbents = (RESULTS.parent / "datasets/incumbents/dfg.ron").read_text()
    for name, label in SCENES:
        formula = re.search(rf'name: "{name}".*?formula: "(.*?)"', incumbents, re.S)[1].replace("\\\n", "").replace("\\", "")
        for scene in ("satin", "dielectric"):
            steps = lgp("specialize", formula, "datasets/dfg.bin", "--scene", scene)
            (RESULTS / f"scenes/{label}_{scene}.txt").write_text(steps)
            rows = [line.split(None, 5) for line in steps.splitlines()[1:] if line.split()[:1] and line.split()[0].isdigit()]
            rows = [(float(row[0]), float(row[2]), row[5]) for row in rows]
            cost, error, _ = rows[0]
            fitted = next(row[1] for row in rows if "fitted" in row[2])
            cheapest = lambda most: min((row for row in rows if row[1] <= most), key=lambda row: (row[0], row[1]))
            best = min((row for row in rows if row[0] <= cost / 2), key=lambda row: row[1])
            cell = lambda row: f"{row[0]:g} ({short(row[1])})"
            lines.append(
                f"| `{name}` | `{scene}` | {cost:g} ({short(error)}) | {short(fitted)} | {cell(cheapest(error))} | "
                f"{cell(cheapest(2 * error))} | {cell(best)} | [{label}_{scene}.txt]({label}_{scene}.txt) |")
    replace("scenes/README.md", "cut", lines)


# Minimax polynomials of Sollya 7.0 (`remez`, `dirtyinfnorm`; functions/minimax.sollya), the error in real numbers: name, form,
# cycles on gcn without the polynomial (a cycle a degree), errors by degree from 1 on.
MINIMAX = [
    ("acos", "sqrt(1 - x)·p(x)", 6, [3.21e-3, 3.27e-4, 3.80e-5, 4.80e-6, 6.38e-7, 8.80e-8, 1.25e-8]),
    ("exp2", "p(x)", 0, [4.31e-2, 2.48e-3, 1.08e-4, 3.71e-6, 1.07e-7]),
    ("atan", "p(x)", 0, [3.56e-2, 2.46e-3, 1.11e-3, 1.07e-4, 2.10e-5, 6.39e-6, 4.09e-7, 1.90e-7]),
    ("atan", "x·p(x²)", 2, [4.96e-3, 6.09e-4, 8.14e-5, 1.15e-5, 1.67e-6]),
    ("srgb", "p(x)", 0, [1.24e-1, 6.34e-2, 3.95e-2, 2.70e-2, 1.95e-2, 1.46e-2, 1.12e-2, 8.68e-3]),
    ("srgb", "p(√x)", 4, [2.23e-2, 5.36e-3, 1.82e-3, 7.25e-4, 3.16e-4, 1.47e-4, 7.05e-5, 3.51e-5]),
    ("srgb", "p(log2 x)", 4, [1.28e-1, 2.47e-2, 3.64e-3, 4.33e-4, 4.32e-5, 3.70e-6, 2.79e-7]),
]


def functions():
    lines = ["| function | cycles | minimax polynomial | its error | the front's error there | proved, rounding included |", "|---|---|---|---|---|---|"]
    for name in dict.fromkeys(row[0] for row in MINIMAX):
        members = json.loads((RESULTS / f"functions/{name}.json").read_text())
        best = {}
        for _, form, cost, errors in (row for row in MINIMAX if row[0] == name):
            for degree, error in enumerate(errors, 1):
                if cost + degree not in best or error < best[cost + degree][0]:
                    best[cost + degree] = (error, f"{form}, degree {degree}")
        for cycles, (error, form) in sorted(best.items()):
            largest = lambda m: m["domain_errors"]["y"]["max"]
            found = min((m for m in members if m["cost"] <= cycles), key=largest)
            truth = found["verdict"].get("truth", [{}])[0]
            proved = f"{truth['most']:.2e}" if "most" in truth else truth.get("status", "not tried")
            lines.append(f"| `{name}` | {cycles} | {form} | {error:.2e} | {largest(found):.2e} | {proved} |")
    replace("functions/README.md", "minimax", lines)


if __name__ == "__main__":
    {"gallery": gallery, "materials": materials, "scenes": scenes, "functions": functions}[sys.argv[1]]()
