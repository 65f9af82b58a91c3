# SPDX-License-Identifier: Apache-2.0
"""examples/bake_scene.sh: all light of a small yard by one command."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "examples" / "scenes"))

from make_courtyard import Gltf, horizontal_quad, look_rotation  # noqa: E402

TETRALIGHT = os.environ["TETRALIGHT_COMMAND"]
LAYERS = ["sun", "sky", "emission"]


def yard():
    """A sunny ground of 3 x 3 m with a white box and a glowing one."""
    gltf = Gltf()
    gltf.node("ground", mesh=gltf.mesh("ground", [gltf.primitive(horizontal_quad(3, 3), "plaster_grey")]))
    gltf.box("box", (0.6, 1.0, 0.6), (-0.6, 0.5, 0), "white")
    gltf.box("lamp", (0.3, 0.3, 0.3), (0.8, 0.15, 0.5), "emissive_warm")
    gltf.node("sun", None, (0, 5, 0), rotation=look_rotation((0.55, -1.0, -0.3)),
              extensions={"KHR_lights_punctual": {"light": 0}})
    return gltf.glb()


class BakeScene(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "yard.glb").write_bytes(yard())

    def bake(self, scene, *options):
        return subprocess.run(["bash", ROOT / "examples/bake_scene.sh", TETRALIGHT, self.folder / scene,
                               self.folder / "out", *options], capture_output=True, text=True)

    def info(self, name):
        found = subprocess.run([TETRALIGHT, "info", "--json", self.folder / "out" / name], capture_output=True,
                               text=True, check=True)
        return json.loads(found.stdout)

    def test_everything_is_baked_from_one_scene(self):
        done = self.bake("yard.glb", "--samples", "16")
        self.assertEqual(done.returncode, 0, done.stderr)
        probes, lightmaps, reflections = map(self.info, ("light.probes", "light.lightmaps", "light.ktx2"))
        for file in (probes, lightmaps):
            self.assertEqual([layer["name"] for layer in file["layers"]], LAYERS)
        self.assertEqual([group["name"] for group in probes["group_list"]], ["grid"])
        self.assertEqual(lightmaps["objects"], 3)
        self.assertEqual([probe["name"] for probe in reflections["probes"]], ["outdoors 1", "sky"])
        for file in (probes, lightmaps, reflections):
            self.assertEqual(file["made_with"]["samples"], 16)
        self.assertIn(b"MX_lightmap", (self.folder / "out/lit.glb").read_bytes())
        self.assertEqual((self.folder / "out/layers.exr").read_bytes()[:4], b"\x76\x2f\x31\x01")

    def test_it_ends_at_the_first_failure(self):
        done = self.bake("yard.glb", "--samples", "none")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--samples", done.stderr)
        made = sorted(path.name for path in (self.folder / "out").iterdir())
        self.assertEqual(made, ["places.json", "reflections.json"])


if __name__ == "__main__":
    unittest.main()
