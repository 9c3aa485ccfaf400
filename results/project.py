"""Projections: how long 100 × 100 groups of 256 rows take, on one thread and on two, and what is recovered of parameters
that are known; and an example with pictures. Writes project/times.csv, the pictures, and the tables in project/README.md.

    python3 results/project.py      lgp on the PATH; about three minutes on two cores
"""

import array
import csv
import json
import math
import resource
import shutil
import statistics
import struct
import subprocess
import tempfile
import time
from pathlib import Path

from tables import RESULTS, replace

PLACE = RESULTS / "project"
SIDE = 100
# `lgp import` holds back one row in four: 256.5 of these are left to a group on average.
POINTS = 342
MODEL = "y = $p*exp2(-$q*(x - $c)^2)"
BOUNDS = "p=0..8,q=0.1..80,c=-2..2"
FIELDS = ["options", "threads", "run", "seconds", "user_seconds", "rmse", "error_p", "error_q", "error_c"]
RUNS = 3

GGX = "a2 = alpha*alpha; d = 1 - n_dot_h^2*(1 - a2); g = n_dot_v + sqrt(a2 + (1 - a2)*n_dot_v^2); y = a2/(3.14159265*d*d*g)"
LOBE = "y = $amplitude*exp(-$sharpness*(1 - n_dot_h))"


def parameters(alpha, size):
    """What is to be recovered, as functions of the place."""
    return 0.5 + alpha * size, 2 + 30 * alpha**2 + 5 * size, 0.6 * math.sin(3 * size) * alpha


def data(path):
    """An array of samples as NumPy writes it: alpha slowest, x fastest."""
    values = array.array("f")
    along = [i / (SIDE - 1) for i in range(SIDE)]
    points = [2 * i / (POINTS - 1) - 1 for i in range(POINTS)]
    for alpha in along:
        for size in along:
            p, q, c = parameters(alpha, size)
            values.extend(p * 2 ** (-q * (x - c) ** 2) for x in points)
    head = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({SIDE}, {SIDE}, {POINTS}), }}".ljust(117) + "\n"
    path.write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode() + values.tobytes())


def lgp(folder, *words):
    return subprocess.run(["lgp", *words], cwd=folder, check=True, stdout=subprocess.PIPE, text=True).stdout


def spent():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def run(folder, options, threads, number):
    words = ["project", MODEL, "rows.bin", "--over", "alpha,size", "--bounds", BOUNDS, "-o", "found.bin", *options.split()]
    begun, before = time.monotonic(), spent()
    done = json.loads(lgp(folder, *words, "--threads", str(threads), "--json", "--quiet"))
    seconds, user = time.monotonic() - begun, spent() - before
    lgp(folder, "export", "found.bin", "-o", "found.csv", "--quiet")
    with open(folder / "found.csv") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    errors = {name: 0.0 for name in "pqc"}
    for row in rows:
        for name, exact in zip("pqc", parameters(float(row["alpha"]), float(row["size"]))):
            errors[name] = max(errors[name], abs(float(row[name]) - exact))
    found = (folder / "found.bin").read_bytes()
    return found, {
        "options": options,
        "threads": threads,
        "run": number,
        "seconds": f"{seconds:.2f}",
        "user_seconds": f"{user:.2f}",
        "rmse": f"{done['rmse']:.2e}",
        **{f"error_{name}": f"{error:.1e}" for name, error in errors.items()},
    }


def times(folder):
    data(folder / "rows.npy")
    lgp(folder, "import", "rows.npy", "-o", "rows.bin", "--axes", "x=-1..1,size=0..1,alpha=0..1", "--corners",
        "--channels", "y", "--quiet")
    for options in ["", "--smooth 1e-4", "--global"]:
        first = None
        for number in range(1, RUNS + 1):
            # Alternating, so that other work on the machine disturbs both.
            for threads in [1, 2]:
                found, row = run(folder, options, threads, number)
                print(row, flush=True)
                first = first or found
                assert found == first, "another result on other threads, or in another run"
                yield row


def table(rows):
    lines = ["| options | threads | seconds | of CPU | largest error of p | of q | of c |", "|---|---|---|---|---|---|---|"]
    for options in dict.fromkeys(row["options"] for row in rows):
        for threads in [1, 2]:
            group = [row for row in rows if (row["options"], row["threads"]) == (options, threads)]
            middle = [f"{statistics.median(float(row[field]) for row in group):.1f}" for field in FIELDS[3:5]]
            errors = [group[0][f"error_{name}"] for name in "pqc"]
            shown = f"`{options}`" if options else "none"
            lines.append(f"| {shown} | {threads} | " + " | ".join(middle + errors) + " |")
    replace("project/README.md", "times", lines)


def example(folder):
    domain = "n_dot_h=0..1,n_dot_v=0..1,alpha=0.1..1"
    lgp(folder, "generate", "--formula", GGX, "--domain", domain, "--points", "40", "-o", "ggx.bin", "--quiet")
    words = ["project", LOBE, "ggx.bin", "--over", "n_dot_v,alpha", "--surface", "n_dot_v=0.5,alpha=0.3",
             "--surface", "n_dot_v=0.5,alpha=0.9", "-o", "lobe.bin"]
    said = lgp(folder, *words)
    said = said.replace(said.split(" in ")[1].split("\n")[0], "… s")
    for name in ["parameters.png", "errors.png"]:
        shutil.copy(folder / "lobe_report" / name, PLACE / name)
    replace("project/README.md", "example", ["```text", *said.rstrip().split("\n"), "```"])


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        example(folder)
        rows = list(times(folder))
    with open(PLACE / "times.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, FIELDS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    table(rows)


if __name__ == "__main__":
    main()
