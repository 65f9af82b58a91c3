# SPDX-License-Identifier: Apache-2.0
"""Scenes that Blender exports: the walk of docs/scenes.md, and the unit of each kind of light."""
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))

from split_rgbm import read_rows  # noqa: E402

TETRALIGHT = os.environ["TETRALIGHT_COMMAND"]
BLENDER = shutil.which("blender")
SYSTEM_PATH = "/usr/bin:/bin"  # Debian's Blender takes NumPy from the first python3 of PATH
LUMENS = 683  # a watt, in the mode "Standard" of Blender's exporter


def run_in_shell(commands, folder):
    """Runs lines of docs as if Tetralight were installed and the folder were the repository."""
    for name, target in (("examples", ROOT / "examples"), ("tetralight", TETRALIGHT)):
        if not (folder / name).exists():
            (folder / name).symlink_to(target)
    path = f"{folder}:{SYSTEM_PATH}"
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=folder, env=dict(os.environ, PATH=path),
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stdout + done.stderr)


def run_blender(script, out):
    """Runs a script in Blender's default scene."""
    done = subprocess.run([BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "--python", script, "--", out],
                          capture_output=True, text=True, env=dict(os.environ, PATH=SYSTEM_PATH))
    if "No module named 'numpy'" in done.stderr:
        raise unittest.SkipTest("Blender cannot export without NumPy (Debian package python3-numpy)")
    if done.returncode != 0:
        raise RuntimeError(done.stdout + done.stderr)


def tetralight(*arguments, **options):
    done = subprocess.run([TETRALIGHT, *map(str, arguments)], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return done


def read_glb(path):
    data = path.read_bytes()
    size, = struct.unpack_from("<I", data, 12)
    return json.loads(data[20:20 + size])


def read_groups(path):
    return json.loads(path.read_text())["groups"]


def info(path):
    return json.loads(tetralight("info", "--json", path).stdout)


def probe_count(volume):
    return info(volume)["probes"]


def irradiance(coefficients, normal):
    """Of red light, as docs/conventions.md has it."""
    x, y, z = normal
    basis = [0.282095, 0.488603 * y, 0.488603 * z, 0.488603 * x, 1.092548 * x * y, 1.092548 * y * z,
             0.315392 * (3 * z * z - 1), 1.092548 * x * z, 0.546274 * (x * x - y * y)]
    return sum(value * rgb[0] for value, rgb in zip(basis, coefficients))


@unittest.skipUnless(BLENDER, "Blender is not installed (Debian package blender): its scenes are not tested")
class FromBlender(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)


class Walk(FromBlender):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.folder / "corner.glb"
        run_blender(ROOT / "examples/blender/make_corner.py", cls.scene)

    def bake(self, *options):
        volume = self.folder / "corner.probes"
        tetralight("bake", self.scene, "-o", volume, "--samples", 64, *options)
        return volume

    def picture(self, volume, *options):
        path = self.folder / "corner.png"
        tetralight("render", self.scene, volume, "-o", path, "--width", 96, "--height", 54, "--exposure", 1.1, *options)
        return read_rows(path.read_bytes())

    def group_size(self):
        nodes = read_glb(self.scene)["nodes"]
        group, = [node for node in nodes if "light_probe_group" in node.get("extras", {})]
        return len(group["children"])

    def test_the_commands_of_the_docs_make_the_picture(self):
        page = (ROOT / "docs/scenes.md").read_text()
        walk, grid = re.findall(r"```sh\n(.*?)```", page.split("## From Blender")[1].split("\n## ")[0], re.S)
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            run_in_shell(walk, folder)
            self.assert_lit((folder / "corner.png").read_bytes())
            run_in_shell(grid, folder)
            placed = read_groups(folder / "places.json")
            self.assertEqual(probe_count(folder / "corner.probes"), sum(len(group["positions"]) for group in placed))

    def assert_lit(self, png):
        rows = read_rows(png)
        middle = rows[len(rows) // 2]
        across = [max(middle[i:i + 3]) for i in range(0, len(middle), 4)]
        self.assertGreater(min(across), 40)  # shadows are not black, either
        self.assertGreater(max(across) - min(across), 40)

    def test_the_empties_are_probes(self):
        volume = self.bake()
        self.assertEqual([group["name"] for group in info(volume)["group_list"]], ["corner"])
        self.assertEqual(probe_count(volume), self.group_size())

    def test_the_picture_is_lit(self):
        volume = self.bake()
        lit, unlit = self.picture(volume), self.picture(volume, "--probes", "none")

        def pixel(rows, x, y):
            return list(rows[y][4 * x:4 * x + 3])

        red, green, blue = pixel(lit, 4, 4)  # the wall on the left
        self.assertGreater(red, 2 * green)
        self.assertGreater(red, 2 * blue)
        for value in pixel(lit, 48, 50):  # the floor in front
            self.assertTrue(100 < value < 250, value)
        front = 40, 28  # of the cube: in its own shadow
        for bright, dark in zip(pixel(lit, *front), pixel(unlit, *front)):
            self.assertGreater(bright, dark + 50)

    def test_lumens_of_the_default_lamp_are_noticed(self):
        lumens = self.folder / "corner_standard.glb"
        code = (ROOT / "examples/blender/make_corner.py").read_text().replace('LIGHTING = "COMPAT"', 'LIGHTING = "SPEC"')
        script = self.folder / "make_corner_standard.py"
        script.write_text(code)
        run_blender(script, lumens)
        self.assertIn("--light-unit watt", tetralight("explain", lumens).stdout)
        placed = tetralight("grid", lumens, "--spacing", 4, "-o", self.folder / "places.json")
        self.assertIn("--light-unit watt", placed.stderr)
        self.assertNotIn("--light-unit", tetralight("explain", lumens, "--light-unit", "watt").stdout)
        self.assertNotIn("--light-unit", tetralight("explain", self.scene).stdout)

    def test_the_cube_moves(self):
        lightmaps = self.folder / "corner.lightmaps"
        tetralight("lightmap", self.scene, "-o", lightmaps, "--samples", 4)
        meshes = [node["name"] for node in read_glb(self.scene)["nodes"] if "mesh" in node]
        self.assertIn("Cube", meshes)
        self.assertEqual(info(lightmaps)["objects"], len(meshes) - 1)


class Units(FromBlender):
    """One light and one probe each: the light is known exactly."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        run_blender(ROOT / "tests/cli/blender_lights.py", cls.folder)

    def irradiance(self, name, normal, *options):
        volume = self.folder / f"{name}.probes"
        tetralight("bake", self.folder / f"{name}.glb", "-o", volume, "--samples", 4096, *options)
        answer = tetralight("query", volume, "--json", input="0 1 0\n").stdout
        return irradiance(json.loads(answer)["irradiance_sh"], normal)

    # The irradiance of a surface that faces a small light, by nine coefficients: 1/4 + 1/2 + 5/16 of the true one.
    FACING = 1.0625

    def assert_near(self, value, expected, tolerance=1e-4):
        self.assertLess(abs(value / expected - 1), tolerance, f"{value}, not {expected}")

    def test_strength_of_a_sun_is_irradiance(self):
        to_sun = (0, math.cos(math.radians(60)), math.sin(math.radians(60)))
        self.assert_near(self.irradiance("sun", to_sun), 3 * self.FACING)
        self.assert_near(self.irradiance("sun_raw", to_sun), 3 * self.FACING)
        self.assert_near(self.irradiance("sun_standard", to_sun), 3 * self.FACING * LUMENS)
        self.assert_near(self.irradiance("sun_standard", to_sun, "--light-unit", "watt"), 3 * self.FACING)

    def test_watts_of_points_and_spots_go_to_all_sides(self):
        watts, distance, up = 1000, 2, (0, 1, 0)
        expected = watts / (4 * math.pi) / distance ** 2 * self.FACING
        for kind in ("point", "spot"):
            with self.subTest(kind):
                self.assert_near(self.irradiance(kind, up), expected)
                self.assert_near(self.irradiance(f"{kind}_standard", up), expected * LUMENS)
                self.assert_near(self.irradiance(f"{kind}_standard", up, "--light-unit", "watt"), expected)
                self.assert_near(self.irradiance(f"{kind}_raw", up), expected * 4 * math.pi)

    def test_strength_of_emission_is_radiance_in_every_mode(self):
        down = (0, -1, 0)
        for name in ("emission", "emission_standard"):
            with self.subTest(name):
                self.assert_near(self.irradiance(name, down), 2 * math.pi, 0.02)

    def test_floor_reflects_the_sun(self):
        albedo = 0.96 * 0.8 + 0.04 * 0.5 / 2  # of Blender's default material, by docs/conventions.md
        self.assert_near(self.irradiance("bounce", (0, -1, 0)), albedo * 3, 0.02)

    def test_sky_of_custom_properties_shines_from_everywhere(self):
        for name in ("sky", "sky_array", "sky_number", "sky_text"):
            for normal in ((0, 1, 0), (0.6, -0.8, 0)):
                with self.subTest(name):
                    self.assert_near(self.irradiance(name, normal), 0.05 * math.pi)


class LightProbeVolumes(FromBlender):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        run_blender(ROOT / "tests/cli/blender_light_probes.py", cls.folder)
        cls.expected = json.loads((cls.folder / "expected.json").read_text())

    def test_probes_are_the_centres_of_the_cells(self):
        volume = self.folder / "v.probes"
        tetralight("tetrahedralize", self.folder / "probes.glb", "-o", volume)
        self.assertEqual([group["name"] for group in info(volume)["group_list"]], sorted(self.expected))
        probes = json.loads(tetralight("info", volume, "--probes", "--json").stdout)["probe_list"]
        for name, places in self.expected.items():
            found = [probe["position"] for probe in probes if probe["groups"] == [name]]
            self.assertEqual(len(found), len(places), name)
            for place in places:
                self.assertLess(min(math.dist(place, position) for position in found), 1e-4, (name, place))

    def test_volumes_without_a_resolution_are_named(self):
        scene = self.folder / "bare.gltf"
        node = {"name": "Hall", "extras": {"light_probe_group": 1}}
        scene.write_text(json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [node]}))
        said = tetralight("tetrahedralize", scene, "-o", self.folder / "none.probes").stderr
        self.assertIn("light probe volumes need extras.probe_resolution", said)


if __name__ == "__main__":
    unittest.main()
