"""`lgp` and two other engines on the same tables with the same CPU seconds; see benches/README.md.

`python3 benches/peers/search.py [--data bias,scale] [--seconds 60] [--seeds 1,2,3,4,5] [--engines …]`

Each engine has one thread, and wall time for its budget: only on a quiet machine are these CPU seconds,
which the table shows. Every front, that of `lgp` too, goes through `examples/polish`: constants
fitted by the same fitter, cycles counted by the same profile. Fronts are added to
results/search/peers/DATA-SECONDS.csv, a (seed, engine) replaced; the table is made again from all.
"""
import argparse
import csv
import io
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HERE = ROOT / "benches/peers"
OUT = ROOT / "results/search/peers"
COSTS = [5, 8, 10, 12, 13, 16, 17, 20, 25, 30]
FIELDS = ["engine", "seed", "cpu_seconds", "cost", "rmse", "max", "formula"]
# Ways to search that the program has; the last two are what its search is compared with.
OURS = {
    "lgp": ["--time", "{seconds}s"],
    "lgp_restarts": ["--time", "{seconds}s", "--immigrants", "1"],
    "lgp_enumeration": ["--exhaustive", "2", "--grammar", "polynomial", "--generations", "0"],
}
ENGINES = [*OURS, "symbolic_regression", "operon"]


def run(command, text=None, env=None):
    """Standard output and CPU seconds of a command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(word) for word in command], input=text, capture_output=True, text=True,
                          cwd=ROOT, env=env)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise SystemExit(f"{command[0]} failed:\n{done.stderr}")
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done.stdout, seconds


def build(engines):
    """The programs that are run; cargo says where it puts them."""
    def target(manifest):
        metadata, _ = run(["cargo", "metadata", "--no-deps", "--format-version", "1",
                           "--manifest-path", manifest])
        return Path(re.search(r'"target_directory":"([^"]*)"', metadata)[1]) / "release"

    examples = ["--example", "search", "--example", "polish"]
    subprocess.run(["cargo", "build", "--release", "--bins", *examples], cwd=ROOT, check=True)
    programs = {name: target(ROOT / "Cargo.toml") / name for name in ["lgp", "examples/search", "examples/polish"]}
    if "symbolic_regression" in engines:
        manifest = HERE / "symbolic_regression/Cargo.toml"
        subprocess.run(["cargo", "build", "--release", "--manifest-path", manifest], check=True)
        programs["symbolic_regression"] = target(manifest) / "peer-symbolic-regression"
    return programs


def tables(programs, folder):
    """Every dataset of the search benchmark as `.bin`, and its search split as CSV."""
    run([programs["examples/search"], "--export", folder])


def formulas(engine, programs, table, seconds, seed, folder):
    """The engine's front as text, and the CPU seconds it took."""
    if engine in OURS:
        out = folder / f"{table.stem}-{engine}-{seed}"
        how = [word.format(seconds=seconds) for word in OURS[engine]]
        _, cpu = run([programs["lgp"], "search", table.with_suffix(".bin"), *how,
                      "--threads", "1", "--seed", seed, "--out", out, "--quiet"])
        front, _ = run([programs["lgp"], "front", out, "--json"])
        return "\n".join(re.findall(r'"formula": "([^"]*)"', front)), cpu
    if engine == "operon":
        return run([sys.executable, HERE / "operon.py", table, seconds, seed])
    return run([programs[engine], table, seconds, seed], env={**os.environ, "RAYON_NUM_THREADS": "1"})


def in_our_words(text):
    """Formulas of the peers in the formula text of `lgp`."""
    text = text.replace("**", "^").replace("inv(", "rcp(").replace("fmin(", "min(").replace("fmax(", "max(")
    return re.sub(r"square\(", "sq(", text)


def without_squares(line):
    """`sq(…)` as a power, innermost first."""
    while "sq(" in line:
        start = line.rindex("sq(")
        depth, end = 0, start + 2
        while True:
            depth += {"(": 1, ")": -1}.get(line[end], 0)
            if depth == 0:
                break
            end += 1
        line = line[:start] + "((" + line[start + 3:end] + ")^2)" + line[end + 1:]
    return line


def measure(args, programs, data, seed, engine, folder):
    table = folder / f"{data}.csv"
    text, cpu = formulas(engine, programs, table, args.seconds, seed, folder)
    text = "\n".join(without_squares(in_our_words(line)) for line in text.splitlines())
    output = table.open().readline().strip().split(",")[-1]
    front, _ = run([programs["examples/polish"], table.with_suffix(".bin"), output], text)
    rows = list(csv.DictReader(io.StringIO(front)))
    print(f"{data} seed {seed} {engine}: {cpu:.1f} CPU s, {len(rows)} formulas", file=sys.stderr)
    if cpu < 0.9 * args.seconds and engine != "lgp_enumeration":
        print("  less than the budget: the machine was busy, or the engine stopped early", file=sys.stderr)
    return [{"engine": engine, "seed": seed, "cpu_seconds": f"{cpu:.1f}", **row} for row in rows]


def read(path):
    return list(csv.DictReader(path.open())) if path.exists() else []


def write(path, rows):
    rows.sort(key=lambda row: (row["engine"], int(row["seed"]), float(row["cost"])))
    temporary = path.with_suffix(".tmp")
    with temporary.open("w", newline="") as file:
        writer = csv.DictWriter(file, FIELDS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    temporary.replace(path)


def error_at(rows, cost):
    return min((float(row["rmse"]) for row in rows if float(row["cost"]) <= cost), default=float("inf"))


def report():
    """A table of the median over seeds at each cost, for each file there is."""
    lines = ["# Side by side with other engines", "",
             "Made by `python3 benches/peers/search.py`. Median over seeds of the least RMSE at a cost or below",
             "(gcn cycles; search grid), behind / the best seed; one thread, the same seconds given, constants of all",
             "fronts fitted by `examples/polish`. `lgp_restarts` fits random formulas alone, `lgp_enumeration` all",
             "polynomials of at most two cycles, however long that takes; CPU seconds of the first two have the end of a",
             "run in them, its two fronts polished, judged and reported.", ""]
    for picture in sorted(OUT.glob("*-time.svg")):
        dark = picture.with_name(picture.stem + "-dark.svg")
        lines += [f'<picture><source media="(prefers-color-scheme: dark)" srcset="{dark.name}">'
                  f'<img src="{picture.name}" alt="Error against seconds, by engine" width="800"></picture>', ""]
    for path in sorted(OUT.glob("*.csv"), key=lambda path: (path.stem.rsplit("-")[0], int(path.stem.rsplit("-")[1]))):
        rows = read(path)
        lines += [f"## {path.stem} s", "", f"| engine | seeds | CPU s | {' | '.join(map(str, COSTS))} |",
                  "|---|---|---|" + "---|" * len(COSTS)]
        for engine in ENGINES:
            own = [row for row in rows if row["engine"] == engine]
            seeds = sorted({row["seed"] for row in own})
            if not seeds:
                continue
            cells = []
            for cost in COSTS:
                errors = [error_at([row for row in own if row["seed"] == seed], cost) for seed in seeds]
                cells.append(f"{statistics.median(errors):.5f} / {min(errors):.5f}")
            cpu = statistics.median(float(row["cpu_seconds"]) for row in own)
            lines.append(f"| {engine} | {len(seeds)} | {cpu:.0f} | {' | '.join(cells)} |")
        lines.append("")
    (OUT / "README.md").write_text("\n".join(lines))
    print("\n".join(lines))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", default="bias,scale")
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--seeds", default="1,2,3,4,5")
    parser.add_argument("--tables", action="store_true", help="measure nothing: only pictures and tables again")
    parser.add_argument("--engines", default=",".join(ENGINES))
    args = parser.parse_args()
    engines = args.engines.split(",")
    programs = build(engines)
    OUT.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        tables(programs, folder)
        for data in [] if args.tables else args.data.split(","):
            path = OUT / f"{data}-{args.seconds}.csv"
            for seed in args.seeds.split(","):
                for engine in engines:
                    found = measure(args, programs, data, seed, engine, folder)
                    others = [row for row in read(path) if (row["engine"], row["seed"]) != (engine, seed)]
                    write(path, others + found)
    subprocess.run([programs["examples/search"], "--tables"], cwd=ROOT, check=True)
    report()


if __name__ == "__main__":
    main()
