"""What engines ship for the DFG terms, measured against the integral: tables of their size and format, sampled
bilinearly, and their formulas; writes results/engines/shipped.csv.

    python3 results/engines.py     after tests/tools/install; lgp on the PATH; wants numpy and pillow; a minute
"""

import base64
import csv
import io
import json
import pathlib
import re
import subprocess
import tempfile

import numpy as np
from PIL import Image

from tables import RESULTS

PROFILES = ["gcn", "rdna2", "valhall"]


def lgp(*arguments):
    return subprocess.run(["lgp", *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def values(folder, name, split, *recipe):
    """The columns of a recipe's rows."""
    data, table = folder / f"{name}.bin", folder / f"{name}.csv"
    lgp("generate", "dfg", *recipe, "-o", data)
    lgp("export", data, "-o", table, "--split", split)
    with table.open() as file:
        rows = list(csv.DictReader(file))
    return {column: np.array([float(row[column]) for row in rows]) for column in rows[0]}


def texture(folder, masking, size):
    """scale and bias at the centres of texels, [n_dot_v][roughness]."""
    found = values(folder, f"{masking}{size}", "search", "--set", f"masking={masking}", "--set", f"points={size}")
    return [found[column].reshape(size, size) for column in ("scale", "bias")]


def bilinear(texels, n_dot_v, roughness):
    """As GPUs filter with clamped coordinates."""
    size = len(texels)
    return between(texels, *(np.clip(x * size - 0.5, 0, size - 1) for x in (n_dot_v, roughness)))


def between(texels, *at):
    """At texels counted from 0."""
    size = len(texels)
    low = [np.minimum(np.floor(x).astype(int), size - 2) for x in at]
    t, u = (x - l for x, l in zip(at, low))
    i, k = low
    return (texels[i, k] * (1 - t) + texels[i + 1, k] * t) * (1 - u) + (
        texels[i, k + 1] * (1 - t) + texels[i + 1, k + 1] * t
    ) * u


def errors(found, truth):
    """The joint RMSE and the largest error over the nodes of a grid, whose edges count half."""
    edge = lambda x: np.where((x < 0.002) | (x > 0.999), 0.5, 1.0)
    weights = edge(truth["n_dot_v"]) * edge(truth["roughness"])
    differences = [found[i] - truth[name] for i, name in enumerate(("scale", "bias"))]
    mean = np.mean([np.average(d**2, weights=weights) for d in differences])
    return np.sqrt(mean), max(np.abs(d).max() for d in differences)


def of_texture(folder, truth, masking, size, order, dtype):
    scale, bias = (x.astype(float) for x in texture(folder, masking, size))
    # Filament's order: what Schlick's weight leaves, and all.
    stored = [scale, bias] if order == "scale, bias" else [bias, scale + bias]
    first, second = (bilinear(x.astype(dtype).astype(float), truth["n_dot_v"], truth["roughness"]) for x in stored)
    return [first, second] if order == "scale, bias" else [second - first, first]


def sampled(n_dot_v, roughness, side=128):
    """scale and bias of one view by visible normals (Heitz 2018), of correlated Smith masking: side * side strata."""
    alpha = roughness**2
    t = (np.arange(side) + 0.5) / side
    # Most strata at the rim of the disk, where smooth surfaces have their tails.
    radius, phi = np.meshgrid(np.sqrt(1 - (1 - t) ** 4), 2 * np.pi * t)
    measure = 4 * (1 - t) ** 3 / side**2
    view = np.array([np.sqrt(1 - n_dot_v**2), 0, n_dot_v])
    stretched = view * [alpha, alpha, 1]
    stretched /= np.linalg.norm(stretched)
    # The tangent frame of a view in the plane y = 0.
    across, along = np.array([0.0, 1.0, 0.0]), np.cross(stretched, [0.0, 1.0, 0.0])
    x, y = radius * np.cos(phi), radius * np.sin(phi)
    lift = 0.5 * (1 + stretched[2])
    y = (1 - lift) * np.sqrt(1 - x**2) + lift * y
    normal = x[..., None] * across + y[..., None] * along
    normal = normal + np.sqrt(np.maximum(0, 1 - x**2 - y**2))[..., None] * stretched
    half = normal * [alpha, alpha, 1]
    half[..., 2] = np.maximum(half[..., 2], 0)
    half /= np.linalg.norm(half, axis=-1, keepdims=True)
    v_dot_h = half @ view
    n_dot_l = (2 * v_dot_h[..., None] * half - view)[..., 2]
    smith = lambda cosine: 0.5 * (np.sqrt(1 + alpha**2 * (1 / np.maximum(cosine, 1e-9) ** 2 - 1)) - 1)
    weight = np.where(n_dot_l > 0, (1 + smith(n_dot_v)) / (1 + smith(n_dot_v) + smith(n_dot_l)), 0)
    bias = np.sum(measure * weight * (1 - v_dot_h) ** 5)
    return np.sum(measure * weight) - bias, bias


def of_eevee(truth, size=64):
    """Blender's texels cover 0 to 1 with the edges, over roughness and sqrt(1 - n_dot_v); its generator clamps both."""
    node = np.linspace(0, 1, size)
    clamped = lambda x: np.clip(x, 1e-4, 0.9999)
    texels = [[sampled(clamped(1 - y**2), clamped(x)) for x in node] for y in node]
    stored = np.array(texels).astype(np.float16).astype(float)
    at = [np.sqrt(1 - truth["n_dot_v"]) * (size - 1), truth["roughness"] * (size - 1)]
    return [between(stored[..., i], *at) for i in (0, 1)]


def of_babylon(truth):
    """The table itself, of Babylon.js from npm: x is what Schlick's weight leaves, y all; each pixel has a divisor, and
    is expanded to halves."""
    script = (RESULTS.parent / "target/tools/node_modules/babylonjs/babylon.js").read_text()
    pictures = re.findall(r"iVBOR[A-Za-z0-9+/=]{5000,}", script)
    pictures = [Image.open(io.BytesIO(base64.b64decode(text))) for text in pictures]
    (picture,) = [picture for picture in pictures if picture.size == (256, 256)]
    pixels = np.asarray(picture).astype(float) / 255
    stored = (pixels[..., :2] ** 2.2 / pixels[..., 3:]).astype(np.float16).astype(float)
    first, second = (bilinear(stored[..., i].T, truth["n_dot_v"], truth["roughness"]) for i in (0, 1))
    return [second - first, first]


def formula(name, incumbents):
    text = (RESULTS.parent / f"datasets/incumbents/{incumbents}.ron").read_text()
    return re.search(rf'name: "{name}".*?formula: "(.*?)"', text, re.S).group(1)


def of_formula(text, dataset):
    scored = json.loads(lgp("eval", text, RESULTS.parent / f"datasets/{dataset}.bin", "--json"))
    validation = scored["validation"]
    costs = json.loads(lgp("cost", text, "--outputs", "scale,bias", "--gpu", ",".join(PROFILES), "--json"))
    return [validation["rmse"], validation["max"]], [(cost["cycles"], cost["registers"]) for cost in costs]


TEXTURES = [
    # engine, masking, size, order, type, bytes of a texel
    ("three.js r187", "correlated", 16, "scale, bias", np.float16, 4),
    ("Bevy 0.19 with dfg_lut", "correlated", 64, "scale, bias", np.float16, 4),
    ("Filament, mobile", "correlated", 64, "Filament's", np.float16, 6),
    ("Filament, desktop", "correlated", 128, "Filament's", np.float16, 6),
    ("Unreal 5, energy table", "correlated", 32, "Filament's", np.float16, 4),
    ("Godot 4.5 Forward+", "schlick", 128, "Filament's", np.float16, 8),
]
FORMULAS = [
    # engine, formula, incumbents, dataset
    ("three.js to r180, Bevy, Godot Mobile, Unreal mobile: Karis 2014", "karis_2014", "dfg", "dfg"),
    ("the same for Schlick's masking", "karis_2014", "dfg", "dfg_schlick"),
    ("Unreal 5, energy by formula", "ue5_ggx_energy", "dfg", "dfg"),
    ("MaterialX 1.39, over alpha", "materialx_rational", "dfg_alpha", "dfg_alpha"),
]


def main():
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        truths = {m: values(folder, m, "validation", "--set", f"masking={m}") for m in ("correlated", "schlick")}
        for engine, masking, size, order, dtype, texel in TEXTURES:
            found = of_texture(folder, truths[masking], masking, size, order, dtype)
            rmse, largest = errors(found, truths[masking])
            kind = f"{size} x {size}, {order}"
            rows.append([engine, kind, f"{rmse:.5f}", f"{largest:.4f}", size * size * texel] + [""] * 6)
        for engine, kind, found, size in [
            ("Babylon.js 9", "256 x 256, Filament's, 8 bits and a divisor", of_babylon(truths["correlated"]), 256 * 256 * 8),
            ("Blender, EEVEE", "64 x 64 with edges, sqrt(1 - n_dot_v)", of_eevee(truths["correlated"]), 64 * 64 * 8),
        ]:
            rmse, largest = errors(found, truths["correlated"])
            rows.append([engine, kind, f"{rmse:.5f}", f"{largest:.4f}", size] + [""] * 6)
    for engine, name, incumbents, dataset in FORMULAS:
        (rmse, largest), costs = of_formula(formula(name, incumbents), dataset)
        cells = [cell for cost in costs for cell in cost]
        rows.append([engine, "formula", f"{rmse:.5f}", f"{largest:.4f}", 0] + cells)
    head = ["engine", "form", "rmse", "max", "bytes"]
    head += [f"{what} {profile}" for profile in PROFILES for what in ("cycles", "registers")]
    with (RESULTS / "engines/shipped.csv").open("w") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])


if __name__ == "__main__":
    main()
