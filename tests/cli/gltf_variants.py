# SPDX-License-Identifier: Apache-2.0
"""One plain scene, and variants of it with one feature of glTF each.

    python3 gltf_variants.py FOLDER      writes all of them
    python3 gltf_variants.py --table     how the program TETRALIGHT_COMMAND reads each

A variant is `right` if its light is that of its twin, a scene that says the same in the plainest way; `told` if
messages name what is left out or approximated; `refused` if the error says what to do. None may be silent.
`wrong` is what a reader sees that misses the feature: its light must differ, or the variant would prove nothing.
"""
import json
import os
import struct
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from gltf_scene import PAINT, PROBES, box_mesh, files_of
from gltf_variant import VARIANTS
import gltf_mesh_variants  # noqa: F401  (these fill the list)
import gltf_node_variants  # noqa: F401


def irradiance_of(volume):
    """The coefficients of all probes of a volume, as docs/file_format.md has them, in the order of their places."""
    section_count, = struct.unpack_from("<I", volume, 12)
    sections = {}
    for i in range(section_count):
        name, offset, count, size = struct.unpack_from("<24sQQQ", volume, 64 + 64 * i)
        data = volume[offset:offset + count * size]
        sections[name.rstrip(b"\0")] = list(struct.iter_unpack(f"<{size // 4}f", data)) if size in (12, 108) else data
    assert len(sections[b"positions"]) == len(PROBES)
    probes = sorted(zip(sections[b"positions"], sections[b"irradiance"]))
    return [c for _, coefficients in probes for c in coefficients]


class Reader:
    """Reads scenes by the program."""

    def __init__(self, command, folder):
        self.command, self.folder, self.known = command, Path(folder), {}

    def write(self, files):
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        for name, data in files.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        return folder / next(iter(files))

    def run(self, *arguments):
        return subprocess.run([self.command, *map(str, arguments)], capture_output=True, text=True)

    def light(self, path, options=()):
        """The coefficients of the light at the probes, or none; and what the bake said."""
        volume = path.parent / "light.probes"
        done = self.run("bake", path, "-o", volume, "--samples", 32, "--threads", 1, "--invalid-probes", "keep",
                        *options)
        if done.returncode != 0:
            return None, done
        return irradiance_of(volume.read_bytes()), done

    def plain_light(self, make):
        """That of a scene that is read without fail."""
        data = make().glb()
        if data not in self.known:
            light, done = self.light(self.write({"scene.glb": data}))
            assert light is not None, done.stderr
            self.known[data] = light
        return self.known[data]

    def parts(self, path, options=()):
        return json.loads(self.run("explain", path, "--json", *options).stdout)["parts"]


def difference(a, b):
    return max(abs(x - y) for x, y in zip(a, b)) / max(map(abs, b))


@dataclass
class Outcome:
    kind: str  # right, told, refused, unclear (an error without a remedy), CRASHED or SILENT
    detail: str
    difference: float = 0.0


def lines_of(parts, or_read):
    """One line for each part that is not read as the format defines it."""
    return [" ".join([p["use"], p["name"], *p["elements"], p["note"], p["remedy"]]) for p in parts
            if p["use"] != "read" or or_read]


def outcome(reader, it):
    path = reader.write(files_of(it.make()))
    light, done = reader.light(path, it.options)
    said = done.stderr.replace(str(path), "SCENE").strip()
    if done.returncode < 0 or (light is None and not said):
        return Outcome("CRASHED", f"exit code {done.returncode}: {said}")
    if light is None:
        return Outcome("refused" if it.expected == "refused" and it.says in said else "unclear", said)
    apart = difference(light, reader.plain_light(it.twin))
    if it.expected == "right":
        return Outcome("right" if apart <= it.tolerance else "SILENT", said, apart)
    for line in lines_of(reader.parts(path, it.options), it.or_read) + said.splitlines():
        if it.says in line and it.expected == "told":
            return Outcome("told", line, apart)
    return Outcome("SILENT", said, apart)


def proves(reader, it):
    """True if a reader that misses the feature would see other light."""
    if it.wrong is None:
        return True
    return difference(reader.plain_light(it.wrong), reader.plain_light(it.twin)) > 5 * it.tolerance


def print_table(command):
    counts = {}
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        reader = Reader(command, folder)
        for it, found in zip(VARIANTS, pool.map(lambda it: outcome(reader, it), VARIANTS)):
            counts[found.kind] = counts.get(found.kind, 0) + 1
            mark = "" if found.kind == it.expected else f"   (expected {it.expected} {it.says})"
            print(f"{found.kind:8} {found.difference:9.2e}  {it.name}{mark}")
            if found.detail and found.kind != "right":
                print(" " * 20 + found.detail.splitlines()[0][:200])
            if not proves(reader, it):
                print(" " * 20 + "its wrong reading has the same light")
    print(len(VARIANTS), counts)


def print_box():
    """The box for gltf_blobs.mjs."""
    positions, normals, uvs, indices = box_mesh()
    flat = {name: [c for v in values for c in v]
            for name, values in (("positions", positions), ("normals", normals), ("uvs", uvs))}
    print(json.dumps({**flat, "indices": indices, "color": PAINT}))


def write_all(folder):
    for i, it in enumerate(VARIANTS):
        for name, data in files_of(it.make()).items():
            path = folder / f"{i:03} {it.name.replace('/', ' ')}" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)


def main(arguments):
    if arguments == ["--table"]:
        print_table(os.environ["TETRALIGHT_COMMAND"])
    elif arguments == ["--box"]:
        print_box()
    else:
        write_all(Path(arguments[0]))


if __name__ == "__main__":
    main(sys.argv[1:])
