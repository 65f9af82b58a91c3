# SPDX-License-Identifier: Apache-2.0
"""What tests in Blender share: an empty scene with the add-on, things to put into it, and the command."""
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import addon_utils
import bpy
from tetralight.gltf_file import read_glb

TETRALIGHT = os.environ["TETRALIGHT_COMMAND"]


def command(*arguments, **options):
    """The standard output of a command."""
    done = subprocess.run([TETRALIGHT, *map(str, arguments)], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return done.stdout


def add(name, data=None, location=(0, 0, 0), parent=None):
    thing = bpy.data.objects.new(name, data)
    thing.location = location
    thing.parent = parent
    bpy.context.scene.collection.objects.link(thing)
    return thing


def add_lamp(kind, watts, location=(0, 0, 3), **properties):
    light = bpy.data.lights.new(kind.lower(), kind)
    light.energy = watts
    for name, value in properties.items():
        setattr(light, name, value)
    return add(kind.lower(), light, location)


def add_plane(size=40.0):
    bpy.ops.mesh.primitive_plane_add(size=size)
    return bpy.context.object


def add_probes(*places):
    """Empties in a group."""
    group = add("group")
    group.tetralight_light_probe_group = True
    for place in places:
        add("probe", None, place, group)
    return group


class BlenderTest(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("tetralight", default_set=True)
        self.addCleanup(addon_utils.disable, "tetralight", default_set=True)
        folder = tempfile.TemporaryDirectory(prefix="tetralight_blender_test_")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.preferences = bpy.context.preferences.addons["tetralight"].preferences
        self.preferences.command = TETRALIGHT
        self.settings = bpy.context.scene.tetralight
        self.settings.quality = "SAMPLES"
        self.settings.samples = 16
        self.output = self.folder / "scene.probes"
        self.settings.output = str(self.output)

    def export(self):
        path = self.folder / "scene.glb"
        self.assertEqual(bpy.ops.tetralight.export(filepath=str(path)), {"FINISHED"})
        return path

    def exported(self):
        """The JSON of the exported scene."""
        return read_glb(self.export())[0]

    def node(self, document, name):
        found, = [node for node in document["nodes"] if node["name"] == name]
        return found

    def extras_of(self, name):
        return self.node(self.exported(), name).get("extras", {})

    def info(self, path, *options):
        return json.loads(command("info", path, "--json", *options))

    def irradiance_sh(self, path, position):
        """Nine RGB coefficients at a position, with glTF's axes."""
        text = " ".join(map(str, position)) + "\n"
        answer = command("query", path, "--json", "--walls", "ignore", input=text)
        return json.loads(answer)["irradiance_sh"]

    def refusal(self, operator, *arguments, **options):
        """The error of an operator that fails."""
        with self.assertRaises(RuntimeError) as caught:
            operator(*arguments, **options)
        return str(caught.exception)
