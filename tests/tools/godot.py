"""godot.py FOLDER: runs FOLDER/functions.gdshaderinc in Godot, on FOLDER/points.f32, in headless Chromium.

Its `evaluate(row, p)` gives the four values of a row's point. They are the bytes of FOLDER/values.f32."""
import hashlib, pathlib, struct, sys

import browser

HERE = pathlib.Path(__file__).resolve().parent


def pack(files):
    """A Godot pack, format 2, of files by name."""
    directory, body = b"", b""
    for name, data in files.items():
        path = f"res://{name}".encode()
        path += b"\0" * (-len(path) % 4)
        directory += struct.pack("<I", len(path)) + path + struct.pack("<QQ", len(body), len(data))
        directory += hashlib.md5(data).digest() + struct.pack("<I", 0)
        body += data + b"\0" * (-len(data) % 16)
    head = struct.pack("<4sIIII", b"GDPC", 2, 4, 0, 0)
    base = len(head) + 4 + 8 + 64 + 4 + len(directory)
    return head + struct.pack("<IQ64xI", 0, base, len(files)) + directory + body


folder = pathlib.Path(sys.argv[1])
files = {path.name: path.read_bytes() for path in (HERE / "godot").iterdir()}
files |= {name: (folder / name).read_bytes() for name in ["functions.gdshaderinc", "points.f32"]}
(folder / "game.pck").write_bytes(pack(files))
path, body = browser.result("godot.html", folder, "swiftshader")
if path != "/result":
    sys.exit(f"godot: {body.decode()}")
(folder / "values.f32").write_bytes(body)
