# SPDX-License-Identifier: Apache-2.0
"""`export --as blender`: Blender runs the script, and has the positions and the light of the export as JSON."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from volumes import bake_courtyard, irradiance, normals, read_json, skip, tetralight

BLENDER = shutil.which("blender")
READER = Path(__file__).with_name("read_blender_mesh.py")
NAMES = ['a "b" \\ \'c\'', "separator \u2028 \"\"\" # quotes", "café = __import__('os')"]


def blender_axes(v):
    """Y up becomes Z up."""
    return [v[0], -v[2], v[1]]


class BlenderMesh(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        folder = Path(cls.folder.name)
        groups = [{"name": name, "positions": [[i, y, z] for y in (0.5, 2, 5) for z in (-1.5, 2)]}
                  for i, name in enumerate(NAMES)]
        (folder / "g.json").write_text(json.dumps({"groups": groups}))
        bake_courtyard(folder / "probes.probes", "--groups", folder / "g.json")
        tetralight("export", folder / "probes.probes", "--as", "json", "-o", folder / "v.json")
        tetralight("export", folder / "probes.probes", "-o", folder / "court.py")
        cls.run_blender(folder)
        cls.expected = read_json(folder / "v.json")
        cls.found = read_json(folder / "found.json")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @staticmethod
    def run_blender(folder):
        done = subprocess.run(
            [BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "--python", folder / "court.py",
             "--python", READER, "--", "court", folder / "found.json"],
            capture_output=True, text=True, env=dict(os.environ, PATH="/usr/bin:/bin"))
        if done.returncode != 0:
            raise RuntimeError(done.stdout + done.stderr)

    def test_vertices_are_the_probes(self):
        self.assertEqual(len(self.found["positions"]), len(self.expected["positions"]))
        for found, position in zip(self.found["positions"], self.expected["positions"]):
            for a, b in zip(found, blender_axes(position)):
                self.assertAlmostEqual(a, b, places=5)

    def test_attributes_hold_the_light_with_blenders_axes(self):
        attributes = self.found["attributes"]
        largest = max(max(irradiance(sh, n)) for sh in self.expected["irradiance_sh"] for n in normals())
        self.assertGreater(largest, 0)
        for i, expected in enumerate(self.expected["irradiance_sh"]):
            found = [c for k in range(9) for c in attributes[f"irradiance_sh_{k}"][i]]
            for n in normals():
                for a, b in zip(irradiance(found, blender_axes(n)), irradiance(expected, n)):
                    self.assertAlmostEqual(a / largest, b / largest, places=5)
            for a, b in zip(attributes["mean_irradiance"][i], expected[:3]):
                self.assertAlmostEqual(a / largest, 0.28209479 * b / largest, places=5)

    def test_attributes_hold_the_rest(self):
        attributes = self.found["attributes"]
        self.assertEqual(attributes["group"], self.expected["group"])
        self.assertEqual(self.found["domains"], ["POINT"])
        self.assertEqual(self.found["active_color"], "mean_irradiance")
        for name in ("validity", "standard_error"):
            self.assertEqual(len(attributes[name]), len(self.expected["positions"]))
            for a, b in zip(attributes[name], self.expected[name]):
                self.assertAlmostEqual(a, b, places=5)

    def test_names_are_names(self):
        self.assertEqual(self.found["groups"], self.expected["groups"])
        self.assertLessEqual(set(NAMES), set(self.found["groups"]))


if __name__ == "__main__":
    if BLENDER is None:
        skip("there is no Blender")
    unittest.main()
