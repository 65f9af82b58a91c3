# SPDX-License-Identifier: Apache-2.0
"""Reads all glTF files of folders, and lists what is refused, what is told, and what no message names.

    TETRALIGHT_COMMAND=build/dev/tetralight python3 gltf_assets.py FOLDER...

Files of the Khronos Group: Debian's package assimp-testmodels, /usr/share/assimp/models. Controllers of headsets: the
npm package @webxr-input-profiles/assets.
"""
import json
import os
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

TETRALIGHT = os.environ["TETRALIGHT_COMMAND"]
SIDES = [(0.8, 0, 0), (-0.8, 0, 0), (0, 0.8, 0), (0, 0, 0.8), (0, 0, -0.8)]  # of probes, in sizes of the scene


def tetralight(*arguments):
    return subprocess.run([TETRALIGHT, *map(str, arguments)], capture_output=True, text=True)


def read_json(path):
    data = path.read_bytes()
    if data[:4] == b"glTF":
        size, = struct.unpack_from("<I", data, 12)
        data = data[20:20 + size]
    return json.loads(data)


def extensions_of(value):
    if isinstance(value, list):
        return set().union(*map(extensions_of, value))
    if not isinstance(value, dict):
        return set()
    names = set(value["extensions"]) if isinstance(value.get("extensions"), dict) else set()
    return names.union(*(extensions_of(v) for key, v in value.items() if key != "extras"))


def unnamed(document, parts):
    """What a file has that no row of the table names."""
    names = {part["name"] for part in parts}
    used = extensions_of(document) | set(document.get("extensionsUsed", []))
    has_targets = any("targets" in p for mesh in document.get("meshes", []) for p in mesh["primitives"])
    features = {"animation": "animations" in document, "camera": "cameras" in document, "skin": "skins" in document,
                "morph": has_targets, "normal map": any("normalTexture" in m for m in document.get("materials", []))}
    return sorted(used - names) + [word for word, is_used in features.items()
                                   if is_used and not any(word in name for name in names)]


def bake(path, bounds):
    """A few samples of probes on all sides of the scene."""
    low, high = bounds["min"], bounds["max"]
    size = max(max(b - a for a, b in zip(low, high)), 1e-3)
    places = [[(a + b) / 2 + size * s for a, b, s in zip(low, high, side)] for side in SIDES]
    with tempfile.TemporaryDirectory() as folder:
        groups = Path(folder) / "groups.json"
        groups.write_text(json.dumps({"groups": [{"name": "around", "positions": places}]}))
        return tetralight("bake", path, "-o", Path(folder) / "light.probes", "--groups", groups,
                          "--only-given-groups", "--samples", 16, "--sky", 1)


def describe(path):
    explained = tetralight("explain", path, "--json")
    if explained.returncode < 0:
        return f"CRASHED ({explained.returncode})"
    if explained.returncode > 0:
        return "refused: " + explained.stderr.strip().replace(str(path), "SCENE")
    table = json.loads(explained.stdout)
    done = bake(path, table["bounds"]) if table["bounds"] else None
    if done is not None and done.returncode != 0:
        return f"bake failed ({done.returncode}): {done.stderr.strip()}"
    told = [part["name"] for part in table["parts"] if part["use"] != "read"]
    missing = unnamed(read_json(path), table["parts"])
    return "read" + (f", told: {', '.join(told)}" if told else "") + (f", NOT NAMED: {', '.join(missing)}"
                                                                       if missing else "")


if __name__ == "__main__":
    for root in map(Path, sys.argv[1:]):
        for file in sorted(p for p in root.rglob("*.gl*") if p.suffix in (".gltf", ".glb")):
            print(f"{file.relative_to(root)}: {describe(file)}", flush=True)
