"""Draws spheres by three.js in headless Chromium, with its own table of the DFG terms and with the formula in
dfg.glsl.js beside this script, and compares the pictures.

    python3 results/engines/three/compare.py     after tests/tools/install; wants numpy
"""

import pathlib
import shutil
import struct
import sys
import tempfile
import zlib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import browser

# How much brighter differences are drawn: the largest would be black.
DIFFERENCE = 16


def png(path, pixels):
    height, width, _ = pixels.shape
    lines = b"".join(b"\0" + line.tobytes() for line in pixels)
    chunk = lambda name, data: struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b"")
    )


def main():
    with tempfile.TemporaryDirectory() as folder:
        for name in ["page.html", "dfg.glsl.js"]:
            shutil.copy(HERE / name, folder)
        path, body = browser.result("case/page.html", folder, "swiftshader")
    if path != "/result":
        sys.exit(body.decode())
    width, height, table, formula = struct.unpack("<4f", body[:16])
    pictures = np.frombuffer(body[16:], np.uint8).reshape(2, int(height), int(width), 4)[:, ::-1, :, :3]
    ours, theirs = pictures[1].astype(int), pictures[0].astype(int)
    difference = np.abs(ours - theirs)
    brighter = np.clip(difference * DIFFERENCE, 0, 255).astype(np.uint8)
    png(HERE / "spheres.png", np.concatenate([pictures[0], pictures[1], brighter]))
    print(f"largest difference {difference.max()} of 255, root mean square {np.sqrt((difference**2.0).mean()):.2f}")
    print(f"median frame: {table:.1f} ms with the table, {formula:.1f} ms with the formula")


main()
