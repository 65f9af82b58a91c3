# SPDX-License-Identifier: Apache-2.0
"""The packed add-on is installed as a user installs it, into the folder of settings of this test."""
import ast
import os
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "packages/blender/tetralight"
SCRIPTS = Path(os.environ["BLENDER_USER_SCRIPTS"])
TOKEN = "a-token-that-only-the-preferences-know"


def pack(path):
    subprocess.run(["python3", str(ROOT / "packages/blender/make_zip.py"), str(path)], check=True)


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        sys.path.remove(str(SOURCES.parent))  # the add-on of the repository is not to be found
        folder = tempfile.TemporaryDirectory(prefix="tetralight_blender_test_")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.zip = cls.folder / "tetralight_blender.zip"
        pack(cls.zip)
        bpy.ops.preferences.addon_install(filepath=str(cls.zip))
        bpy.ops.preferences.addon_enable(module="tetralight")

    def preferences(self):
        return bpy.context.preferences.addons["tetralight"].preferences

    def test_it_has_the_sources_and_the_licence(self):
        names = zipfile.ZipFile(self.zip).namelist()
        sources = [f"tetralight/{path.name}" for path in SOURCES.iterdir() if path.suffix in (".py", ".toml")]
        self.assertEqual(sorted(names), sorted([*sources, "tetralight/LICENSE"]))

    def test_the_same_sources_give_the_same_bytes(self):
        again = self.folder / "again.zip"
        pack(again)
        self.assertEqual(again.read_bytes(), self.zip.read_bytes())

    def test_blender_runs_the_installed_one(self):
        installed = Path(sys.modules["tetralight"].__file__)
        self.assertEqual(installed, SCRIPTS / "addons/tetralight/__init__.py")
        self.assertTrue(bpy.ops.tetralight.bake.poll())

    def test_it_bakes(self):
        bpy.ops.wm.read_homefile(use_empty=True)
        bpy.ops.mesh.primitive_plane_add(size=10)
        bpy.ops.tetralight.add_probe_group(size=(2, 2, 1), spacing=1, location=(0, 0, 1))
        settings = bpy.context.scene.tetralight
        settings.quality, settings.samples, settings.output = "SAMPLES", 16, str(self.folder / "scene.probes")
        self.preferences().bake_with, self.preferences().command = "COMMAND", os.environ["TETRALIGHT_COMMAND"]
        self.assertEqual(bpy.ops.tetralight.bake(), {"FINISHED"})
        self.assertTrue((self.folder / "scene.probes").is_file())

    def test_blender_keeps_the_preferences(self):
        preferences = self.preferences()
        preferences.bake_with, preferences.address, preferences.token = "SERVICE", "http://127.0.0.1:9", TOKEN
        bpy.ops.wm.save_userpref()
        script = ("import bpy; p = bpy.context.preferences.addons['tetralight'].preferences; "
                  "print('saved:', p.bake_with, p.address, p.token)")
        command = [bpy.app.binary_path, "-b", "--python-exit-code", "1", "--python-expr", script]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertIn(f"saved: SERVICE http://127.0.0.1:9 {TOKEN}", done.stdout, done.stderr)


class Manifest(unittest.TestCase):
    """For Blender 4.2 and later; this Blender does not read it."""

    def test_it_agrees_with_bl_info(self):
        import tomllib

        manifest = tomllib.loads((SOURCES / "blender_manifest.toml").read_text())
        info = self.bl_info()
        self.assertEqual(manifest["id"], "tetralight")
        self.assertEqual(manifest["version"], ".".join(map(str, info["version"])))
        for name, value in (("name", "name"), ("tagline", "description"), ("maintainer", "author")):
            self.assertEqual(manifest[name], info[value])
        self.assertEqual(manifest["schema_version"], "1.0.0")
        self.assertEqual(manifest["type"], "add-on")
        self.assertEqual(manifest["license"], ["SPDX:Apache-2.0"])
        # Rules of the format: no full stop at the end, at most 64 characters.
        for text in (manifest["tagline"], *manifest["permissions"].values()):
            self.assertTrue(len(text) <= 64 and text[-1] != ".", text)

    @staticmethod
    def bl_info():
        tree = ast.parse((SOURCES / "__init__.py").read_text())
        value, = [node.value for node in tree.body if isinstance(node, ast.Assign) and node.targets[0].id == "bl_info"]
        return ast.literal_eval(value)
