"""Writes for each engine a function in the place of its own, as a file beside this one; dropins.csv, with error, cycles,
registers and proofs; and spheres.png in each folder but those of three.js, which draws its own
(three/compare.py), and Unreal, whose terms are Bevy's.

    python3 results/engines/dropins.py     after the searches of README.md and tests/tools/install; lgp on the PATH;
                                           wants numpy and pillow; two minutes
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import engines
from engines import PROFILES

ROOT = HERE.parents[1]

# What a run's bias and total are in the order of each engine; total may come out below bias by its error.
SCALE_BIAS = "return.x = max(total - bias, 0); return.y = bias"
BIAS_TOTAL = "return.x = bias; return.y = max(total, bias)"
# The third value, of cloth, is another function's.
AND_CLOTH = BIAS_TOTAL + "; return.z = 0"
FRESNEL = "return = F0*max(total - bias, 0) + F90*bias"
OUTPUTS = "scale = max(total - bias, 0)"

# What else replaces what ships: the cheapest that errs no more, or else the best of at most 50 cycles.
DROPINS = [
    # engine, file, data, cycles at most of bias and total, how it is written, its results
    ("three.js", "three/dfg.glsl.js", "dfg", 20, ["--for", "three", "--signature", "vec2 dfg(float dotNV, float roughness)"], SCALE_BIAS),
    (
        "Bevy", "bevy/F_AB.wgsl", "dfg", 10,
        ["--for", "bevy", "--signature", "fn F_AB(perceptual_roughness: f32, NdotV: f32) -> vec2<f32>"], SCALE_BIAS,
    ),
    (
        "Unreal mobile", "unreal/EnvBRDFApprox.ush", "dfg", 10,
        ["--for", "unreal", "--half", "--signature", "half2 EnvBRDFApproxLazarov(half Roughness, half NoV)"], SCALE_BIAS,
    ),
    (
        "Filament", "filament/prefilteredDFG.glsl", "dfg", 48,
        ["--for", "filament", "--signature", "vec3 prefilteredDFG(float perceptualRoughness, float NoV)"], AND_CLOTH,
    ),
    (
        "Babylon.js", "babylon/getBRDFLookup.js", "dfg", 44,
        ["--for", "babylon", "--signature", "vec3 getBRDFLookup(float NdotV, float perceptualRoughness)"], AND_CLOTH,
    ),
    (
        "Blender", "blender/dfg.osl", "dfg", 48,
        [
            "--for", "blender", "--signature",
            "shader dfg(float n_dot_v = 0.5, float roughness = 0.5, output float scale = 0, output float bias = 0)",
        ],
        OUTPUTS,
    ),
    (
        "Godot Mobile", "godot/prefiltered_dfg.gdshaderinc", "dfg_schlick", 13,
        ["--for", "godot", "--signature", "vec2 prefiltered_dfg(float lod, float NoV)", "--let", "roughness = lod"],
        BIAS_TOTAL,
    ),
    (
        "MaterialX", "materialx/mx_ggx_dir_albedo.glsl", "dfg_alpha", 16,
        ["--lang", "glsl", "--signature", "vec3 mx_ggx_dir_albedo_analytic(float NdotV, float alpha, vec3 F0, vec3 F90)"],
        FRESNEL,
    ),
]


def lgp(*arguments):
    done = subprocess.run(["lgp", *map(str, arguments)], cwd=ROOT, capture_output=True, text=True)
    if done.returncode not in (0, 4):
        sys.exit(done.stderr)
    return done.stdout


def of_run(data, cycles):
    """The formula of the run's most accurate member of so many cycles at most."""
    members = json.loads(lgp("front", f"runs/total_{data}", "--json"))
    return min((m for m in members if m["cost"] <= cycles), key=lambda m: m["rmse"])["formula"]


def costs(formula, results):
    """Cycles and registers, as the file computes it."""
    assigned = results.replace("return", "r").replace(".", "_").replace("; r_z = 0", "")
    assigned = assigned.replace("r = F0*max(total - bias, 0) + F90*bias", OUTPUTS)
    outputs = "scale,bias" if assigned == OUTPUTS else "r_x,r_y"
    found = json.loads(lgp("cost", f"{formula}; {assigned}", "--outputs", outputs, "--gpu", ",".join(PROFILES), "--json"))
    return [f"{cost[what]:g}" for cost in found for what in ("cycles", "registers")]


def proofs(data, formula):
    """True if bias, scale and their sum, the larger of total and bias, are proved to be in [0, 1] on the whole domain, in
    f32 and within the precision of GPUs."""
    domain = f"n_dot_v=0..1,{'alpha' if data == 'dfg_alpha' else 'roughness'}=0..1"
    text = f"{formula}; x = bias; y = max(total - bias, 0); sum = max(total, bias)"
    claims = json.loads(lgp("check", text, "--domain", domain.split(",")[0], "--domain", domain.split(",")[1], "--range", "0..1", "--json"))
    claims = claims["claims"]
    assert len(claims) == 9, claims
    return all(claim["status"] == claim["gpu"]["status"] == "proved" for claim in claims)


def errors(path, data, formula):
    """Of scale and bias on the validation split in single precision; the file computes it, says lgp verify."""
    checked = json.loads(lgp("verify", path, f"datasets/{data}.bin", "--max-error", 1, "--json"))
    assert checked["as_commented"], path
    scored = json.loads(lgp("eval", f"{formula}; {OUTPUTS}", f"datasets/{data}.bin", "--json"))
    return scored["validation"]


def function(folder, data, cycles):
    """scale and bias as a function of numpy arrays."""
    path = pathlib.Path(folder) / f"{data}_{cycles}.py"
    lgp("emit", f"runs/total_{data}", "--max-cost", cycles, "--lang", "python", "--name", "f", "--let",
        "return.x = max(total - bias, 0); return.y = bias", "-o", path)
    scope = {}
    exec(path.read_text(), scope)
    return lambda n_dot_v, roughness: scope["f"](np.float32(n_dot_v), np.float32(roughness))


def of_text(formula):
    """A published formula as a function of numpy arrays."""
    names = dict(np=np, min=np.minimum, max=np.maximum, exp2=np.exp2, saturate=lambda x: np.clip(x, 0, 1), pow=np.power)

    def values(n_dot_v, roughness):
        scope = dict(names, n_dot_v=n_dot_v, roughness=roughness, alpha=roughness)
        for statement in formula.replace("^", "**").replace("\n", ";").split(";"):
            exec(statement.strip(), scope)
        return scope["scale"], scope["bias"]

    return values


def shipped(engine, folder):
    """What the engine has now, as a function, and its name."""
    tables = {"three.js": 16, "Filament": 64}
    if engine in tables:
        texels = [x.astype(np.float16).astype(float) for x in engines.texture(folder, "correlated", tables[engine])]
        return lambda *at: [engines.bilinear(x, *at) for x in texels]
    if engine == "Babylon.js":
        return lambda *at: engines.of_babylon(dict(zip(("n_dot_v", "roughness"), at)))
    if engine == "Blender":
        return lambda *at: engines.of_eevee(dict(zip(("n_dot_v", "roughness"), at)))
    if engine == "MaterialX":
        return of_text(engines.formula("materialx_rational", "dfg_alpha"))
    return of_text(engines.formula("karis_2014", "dfg"))


def exact(truth):
    """The integral between the nodes of the validation split, which has the edges."""
    size = round(len(truth["n_dot_v"]) ** 0.5)
    nodes = [truth[column].reshape(size, size) for column in ("scale", "bias")]
    return lambda *at: [engines.between(x, *(np.asarray(a) * (size - 1) for a in at)) for x in nodes]


SIZE, COLUMNS, GOLD = 96, 8, np.array([1.0, 0.78, 0.34])
# How much brighter differences are drawn: the largest would be black.
BRIGHTER = 8


def spheres(terms, over_alpha):
    """A row of gold spheres under a sky, roughness 0 to 1, linear colours."""
    y, x = (np.mgrid[0:SIZE, 0:SIZE] + 0.5) / SIZE * 2.1 - 1.05
    inside = x**2 + y**2 < 1
    n_dot_v = np.sqrt(np.clip(1 - x**2 - y**2, 0, 1))
    row = []
    for roughness in np.linspace(0, 1, COLUMNS):
        # The sky's horizon is as soft as the lobe is wide.
        up = -2 * n_dot_v * y
        sky = 0.15 + 0.85 / (1 + np.exp(-up / (0.04 + 0.4 * roughness**2)))
        second = np.full(n_dot_v.shape, roughness**2 if over_alpha else roughness)
        scale, bias = terms(n_dot_v, second)
        colour = sky[..., None] * (np.asarray(scale)[..., None] * GOLD + np.asarray(bias)[..., None])
        row.append(np.where(inside[..., None], colour, 0.05))
    return np.concatenate(row, axis=1)


def displayed(colour):
    colour = np.clip(colour, 0, 1)
    return np.where(colour < 0.0031308, 12.92 * colour, 1.055 * np.maximum(colour, 1e-9) ** (1 / 2.4) - 0.055) * 255


def picture(path, rows):
    exact_row, ships, ours = (np.round(displayed(row)) for row in rows)
    differences = [np.abs(row - exact_row) * BRIGHTER for row in (ships, ours)]
    image = np.concatenate([exact_row, ships, ours, *differences])
    if path.parent.name not in ("three", "unreal"):
        Image.fromarray(np.clip(image, 0, 255).astype(np.uint8)).save(path, optimize=True)
    return [int(np.abs(row - exact_row).max()) for row in (ships, ours)]


def main():
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        recipes = {"dfg": [], "dfg_schlick": ["--set", "masking=schlick"], "dfg_alpha": ["--set", "alpha=given"]}
        truths = {data: engines.values(folder, data, "validation", *recipe) for data, recipe in recipes.items()}
        for truth in truths.values():
            truth["roughness"] = truth.get("roughness", truth.get("alpha"))
        for engine, file, data, cycles, form, results in DROPINS:
            formula, path = of_run(data, cycles), HERE / file
            path.parent.mkdir(exist_ok=True)
            lgp("emit", f"runs/total_{data}", "--max-cost", cycles, *form, "--let", results, "-o", path)
            scored, ships = errors(path, data, formula), shipped(engine, folder)
            of_ships = engines.errors(ships(truths[data]["n_dot_v"], truths[data]["roughness"]), truths[data])
            over_alpha = data == "dfg_alpha"
            terms = [exact(truths[data]), ships, function(folder, data, cycles)]
            seen = picture(path.parent / "spheres.png", [spheres(term, over_alpha) for term in terms])
            rows.append([engine, file, data, *costs(formula, results), f"{scored['rmse']:.5f}", f"{scored['max']:.4f}",
                         f"{of_ships[0]:.5f}", f"{of_ships[1]:.4f}", *seen, "proved" if proofs(data, formula) else "open"])
            print(*rows[-1])
    head = ["engine", "file", "data", *(f"{what} {profile}" for profile in PROFILES for what in ("cycles", "registers"))]
    head += ["rmse", "max", "shipped rmse", "shipped max", "shipped spheres", "spheres", "in 0..1 with its sum"]
    with (HERE / "dropins.csv").open("w") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])


if __name__ == "__main__":
    main()
