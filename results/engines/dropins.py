"""Writes a function for each engine in the place of its DFG terms, as its own file beside this one, and dropins.csv:
error, cycles, registers and proofs of each.

    python3 results/engines/dropins.py     after the searches of README.md; lgp on the PATH; a minute
"""

import csv
import json
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PROFILES = ["gcn", "rdna2", "valhall"]

# What a run's total and bias are in the order of each engine. Of rounding to halves alone total may be below bias.
SCALE_BIAS = "return.x = max(total - bias, 0); return.y = bias"
BIAS_TOTAL = "return.x = bias; return.y = max(total, bias)"
# The third value, of cloth, stays the table's.
AND_CLOTH = BIAS_TOTAL + "; return.z = 0"
FRESNEL = "return = F0*max(total - bias, 0) + F90*bias"

DROPINS = [
    # file, data, cycles at most without what is around it, how it is written
    ("three/dfg.glsl.js", "dfg", 18, ["--for", "three", "--signature", "vec2 dfg(float dotNV, float roughness)"], SCALE_BIAS),
    (
        "bevy/F_AB.wgsl", "dfg", 13,
        ["--for", "bevy", "--signature", "fn F_AB(perceptual_roughness: f32, NdotV: f32) -> vec2<f32>"], SCALE_BIAS,
    ),
    (
        "unreal/EnvBRDFApprox.ush", "dfg", 13,
        ["--for", "unreal", "--half", "--signature", "half2 EnvBRDFApproxLazarov(half Roughness, half NoV)"], SCALE_BIAS,
    ),
    (
        "filament/prefilteredDFG.glsl", "dfg", 25,
        ["--for", "filament", "--signature", "vec3 prefilteredDFG(float perceptualRoughness, float NoV)"], AND_CLOTH,
    ),
    (
        "babylon/getBRDFLookup.js", "dfg", 25,
        ["--for", "babylon", "--signature", "vec3 getBRDFLookup(float NdotV, float perceptualRoughness)"], AND_CLOTH,
    ),
    ("blender/dfg.osl", "dfg", 48, ["--for", "blender"], None),
    (
        "godot/prefiltered_dfg.gdshaderinc", "dfg_schlick", 13,
        ["--for", "godot", "--signature", "vec2 prefiltered_dfg(float lod, float NoV)", "--let", "roughness = lod"],
        BIAS_TOTAL,
    ),
    (
        "materialx/mx_ggx_dir_albedo.glsl", "dfg_alpha", 14,
        ["--lang", "glsl", "--signature", "vec3 mx_ggx_dir_albedo_analytic(float NdotV, float alpha, vec3 F0, vec3 F90)"],
        FRESNEL,
    ),
]


def lgp(*arguments, check=True):
    done = subprocess.run(["lgp", *map(str, arguments)], cwd=ROOT, check=check, capture_output=True, text=True)
    return done.stdout


def member(data, cycles):
    """The run's most accurate formula of so many cycles at most."""
    members = json.loads(lgp("front", f"runs/total_{data}", "--json"))["members"]
    return min((m for m in members if m["cost"] <= cycles), key=lambda m: m["rmse"])


def written(file, data, cycles, form, values):
    lets = ["--let", values] if values else []
    (HERE / file).parent.mkdir(exist_ok=True)
    lgp("emit", f"runs/total_{data}", "--max-cost", cycles, *form, *lets, "-o", HERE / file)


def errors(file, data, formula):
    """Of scale and bias on the validation split, in singles; and of the file's own results, in its own precision."""
    of_file = json.loads(lgp("verify", HERE / file, f"runs/{data}_total.bin", "--max-error", 1, "--json"))
    assert of_file["as_commented"], file
    singles = json.loads(lgp("eval", f"{formula}; scale = max(total - bias, 0)", f"datasets/{data}.bin", "--json"))
    return singles["validation"], of_file["validation"]


def proved(data, formula):
    """True if bias, scale and their sum, which is the larger of total and bias, stay in [0, 1] on the whole domain."""
    inputs = "n_dot_v=0..1,alpha=0..1" if data == "dfg_alpha" else "n_dot_v=0..1,roughness=0..1"
    parts = f"{formula}; b = bias; scale = max(total - bias, 0); sum = max(total, bias)"
    verdict = json.loads(lgp("check", parts, "--domain", inputs, "--range", "0..1", "--json", check=False))
    return verdict


def main():
    rows = []
    for file, data, cycles, form, values in DROPINS:
        formula = member(data, cycles)["formula"]
        written(file, data, cycles, form, values)
        print(file, formula)
        print(json.dumps(proved(data, formula))[:600])
        print(errors(file, data, formula))


if __name__ == "__main__":
    main()
