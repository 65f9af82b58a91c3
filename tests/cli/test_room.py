# SPDX-License-Identifier: Apache-2.0
"""The room of the gallery: what examples/scenes/make_room.py says of it holds."""
import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "examples/scenes/make_room.py"
TETRALIGHT = os.environ["TETRALIGHT_COMMAND"]
DARKEST, BRIGHTEST = 0.04, 0.86  # albedos that the script names


class Glb:
    """The JSON of a .glb file, and its accessors as lists of tuples."""

    def __init__(self, data):
        length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20:20 + length])
        self.binary = data[28 + length:]

    def values(self, index):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        letter = {5126: "f", 5123: "H"}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor["type"]]
        flat = struct.unpack_from(f"<{accessor['count'] * width}{letter}", self.binary, view["byteOffset"])
        return list(zip(*[iter(flat)] * width))


class Room(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.scenes = [Path(cls.folder.name) / name for name in ("first.glb", "second.glb", "screen.glb")]
        for scene in cls.scenes:
            options = ["--screen"] if scene.stem == "screen" else []
            subprocess.run([sys.executable, "-B", str(SCRIPT), str(scene), *options], check=True)
        cls.room = Glb(cls.scenes[0].read_bytes())

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_is_the_same_on_every_run(self):
        self.assertEqual(self.scenes[0].read_bytes(), self.scenes[1].read_bytes())

    def test_is_read_as_its_format_defines_it(self):
        for scene in self.scenes[1:]:
            done = subprocess.run([TETRALIGHT, "explain", str(scene), "--json"], check=True, capture_output=True)
            parts = json.loads(done.stdout)["parts"]
            self.assertEqual([part["name"] for part in parts if part["changes_light"]], [])

    def test_albedos_are_those_of_a_room(self):
        for material in self.room.json["materials"]:
            surface = material["pbrMetallicRoughness"]
            if "baseColorTexture" in surface:
                continue  # the factor is a tint
            for channel in surface["baseColorFactor"][:3]:
                self.assertLessEqual(channel, BRIGHTEST, material["name"])
            self.assertGreaterEqual(max(surface["baseColorFactor"][:3]), DARKEST, material["name"])

    def test_fronts_of_triangles_are_where_their_normals_point(self):
        for mesh in self.room.json["meshes"]:
            for primitive in mesh["primitives"]:
                positions = self.room.values(primitive["attributes"]["POSITION"])
                normals = self.room.values(primitive["attributes"]["NORMAL"])
                indices = [i for (i,) in self.room.values(primitive["indices"])]
                for corners in zip(*[iter(indices)] * 3):
                    self.assertGreater(facing(positions, normals, corners), 0, f"{mesh['name']}: {corners}")


def facing(positions, normals, corners):
    """The area vector of a triangle times the sum of its normals."""
    a, b, c = (positions[i] for i in corners)
    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    area = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return sum(n * s for n, s in zip(area, map(sum, zip(*(normals[i] for i in corners)))))


if __name__ == "__main__":
    unittest.main()
