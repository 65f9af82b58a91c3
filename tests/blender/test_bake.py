# SPDX-License-Identifier: Apache-2.0
"""Bakes by the command: results, progress, cancelling and failures."""
import re
import stat
import subprocess
import time
from pathlib import Path

import bpy
from blender_test import TETRALIGHT, BlenderTest, add_lamp, add_plane, add_probes
from tetralight import operators
from tetralight.baking import Bake, BakeSettings, CommandBake

ROOT = Path(__file__).resolve().parents[2]
PLACES = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (1, 2)]


class BakeTest(BlenderTest):
    def setUp(self):
        super().setUp()
        add_plane()
        add_lamp("POINT", 100)

    def bake(self):
        self.assertEqual(bpy.ops.tetralight.bake(), {"FINISHED"})

    def files(self):
        return sorted(entry.name for entry in self.folder.iterdir())

    def script(self, text):
        """A program in place of the command."""
        path = self.folder / "program"
        path.write_text("#!/bin/sh\n" + text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        self.preferences.command = str(path)

    def start(self):
        """A bake as the user interface begins it."""
        operators.start_bake(bpy.context)
        self.addCleanup(operators.cancel_bake)
        return operators.running.bake

    def wait_for(self, is_so, seconds=120):
        end = time.monotonic() + seconds
        while not is_so():
            self.assertLess(time.monotonic(), end, "it did not happen")
            time.sleep(0.01)


class Results(BakeTest):
    def test_the_volume_has_the_probes_and_the_settings(self):
        add_probes(*PLACES)
        self.settings.mixed_lighting = "shadowmask"
        self.settings.samples = 48
        self.bake()
        facts = self.info(self.output)
        self.assertEqual(facts["probes"], len(PLACES))
        self.assertEqual(facts["made_with"]["samples"], 48)
        self.assertEqual(facts["made_with"]["mixed_lighting"], "shadowmask")
        self.assertEqual(self.files(), ["scene.probes"])

    def test_a_target_error_is_a_setting(self):
        add_probes(*PLACES)
        self.settings.quality = "ERROR"
        self.settings.target_error = 30
        self.bake()
        self.assertAlmostEqual(self.info(self.output)["made_with"]["target_error"], 0.3, 6)

    def test_probes_are_placed(self):
        bpy.ops.mesh.primitive_cube_add(size=4, location=(0, 0, 2))
        self.settings.places_probes = True
        self.settings.spacing = 3
        self.bake()
        self.assertGreater(self.info(self.output)["probes"], 8)

    def test_the_output_is_beside_the_blend_file(self):
        add_probes(*PLACES)
        self.settings.output = ""
        bpy.ops.wm.save_as_mainfile(filepath=str(self.folder / "hall.blend"))
        self.bake()
        self.assertIn("hall.probes", self.files())

    def test_the_balls_of_a_bake_are_not_in_the_next_one(self):
        add_probes(*PLACES)
        self.bake()
        first = self.output.read_bytes()
        ball = operators.shown_probes(bpy.context.scene)
        ball.hide_render = False
        self.bake()
        self.assertEqual(self.output.read_bytes(), first)
        self.assertEqual([node["name"] for node in self.exported()["nodes"] if "mesh" in node], ["Plane"])

    def test_warnings_of_the_command_are_shown(self):
        bpy.ops.mesh.primitive_cube_add(size=4, location=(0, 0, 2))
        self.settings.places_probes = True
        bpy.data.objects.remove(bpy.data.objects["point"])
        bake = self.start()
        self.wait_for(bake.is_over)
        _, warnings = operators.finish_bake()
        self.assertTrue(any("no light of the scene reaches any space" in warning for warning in warnings), warnings)


class Progress(BakeTest):
    def test_it_counts_probes(self):
        add_probes(*PLACES)
        self.settings.samples = 4000000
        bake = self.start()
        self.wait_for(lambda: bake.progress.fraction is not None)
        self.assertRegex(bake.progress.text, f"Baking probe [0-9]+ of {len(PLACES)}")
        self.assertTrue(0 <= bake.progress.fraction <= 1)


class Cancelling(BakeTest):
    def test_it_leaves_no_file_and_no_program(self):
        add_probes(*PLACES)
        self.output.write_bytes(b"old")
        self.settings.samples = 16777216
        bake = self.start()
        self.wait_for(lambda: bake.progress.fraction is not None)
        temporary = bake.scene.parent
        self.assertTrue(temporary.is_dir())
        self.assertTrue(programs_with(temporary))
        operators.cancel_bake()
        self.assertTrue(bake.is_over())
        self.assertIsNone(bake.error)
        self.assertFalse(temporary.exists())
        self.assertEqual(programs_with(temporary), [])
        self.assertEqual(self.files(), ["scene.probes"])
        self.assertEqual(self.output.read_bytes(), b"old")

    def test_loading_another_file_cancels(self):
        add_probes(*PLACES)
        self.settings.samples = 16777216
        bake = self.start()
        bpy.ops.wm.read_homefile(use_empty=True)
        self.assertIsNone(operators.running)
        self.assertFalse(bake.scene.parent.exists())
        self.assertEqual(programs_with(bake.scene.parent), [])

    def test_quitting_blender_cancels(self):
        script = f"""
import sys
sys.path[:0] = {[str(ROOT / "tests/blender"), str(ROOT / "packages/blender")]}
import addon_utils, bpy, blender_test
addon_utils.enable("tetralight", default_set=True)
from tetralight import operators
bpy.context.preferences.addons["tetralight"].preferences.command = {TETRALIGHT!r}
blender_test.add_plane()
blender_test.add_probes((0, 0, 1))
settings = bpy.context.scene.tetralight
settings.quality, settings.samples, settings.output = "SAMPLES", 16777216, {str(self.output)!r}
operators.start_bake(bpy.context)
while operators.running.bake.progress.fraction is None:
    pass
print("temporary:", operators.running.bake.scene.parent)
"""
        command = [bpy.app.binary_path, "-b", "--factory-startup", "--python-exit-code", "1", "--python-expr", script]
        done = subprocess.run(command, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        temporary = Path(re.search("temporary: (.*)", done.stdout)[1])
        self.assertFalse(temporary.exists())
        self.assertEqual(programs_with(temporary), [])
        self.assertEqual(self.files(), [])

    def test_disabling_the_add_on_cancels(self):
        add_probes(*PLACES)
        self.settings.samples = 16777216
        temporary = self.start().scene.parent
        bpy.ops.preferences.addon_disable(module="tetralight")
        self.assertFalse(temporary.exists())
        self.assertEqual(programs_with(temporary), [])


class Failures(BakeTest):
    """Each is one error, and the old volume stays."""

    def setUp(self):
        super().setUp()
        self.output.write_bytes(b"old")

    def refused(self):
        error = self.refusal(bpy.ops.tetralight.bake)
        self.assertEqual(self.output.read_bytes(), b"old")
        self.assertIsNone(operators.running)
        self.assertEqual(error.count("Error:"), 1)
        return error

    def test_there_are_no_probes(self):
        self.assertIn("scene.glb: the scene has no probe groups", self.refused())

    def test_a_wrong_command(self):
        add_probes(*PLACES)
        for command, reason in ((str(self.folder / "none"), "No such file"), (str(self.folder), "Permission denied"),
                                ("", "the command is empty")):
            with self.subTest(command):
                self.preferences.command = command
                error = self.refused()
                self.assertIn(reason, error)
                self.assertIn("preferences", error)

    def test_a_command_that_is_not_tetralight(self):
        add_probes(*PLACES)
        for text, reason in (("exit 0", "does not answer as Tetralight does"),
                             ("echo 'bad things' >&2; exit 3", "code 3"), ("echo '{}'", "wrote no probe volume"),
                             ('echo "{}"; echo none > "$(dirname "$2")/scene.probes"', "this is not a probe volume")):
            with self.subTest(text):
                self.script(text)
                self.assertIn(reason, self.refused())

    def test_the_error_of_the_command_is_shown(self):
        add_probes(*PLACES)
        self.script("""echo '{"error": {"code": "corrupt", "message": "the third wall is missing"}}'; exit 1""")
        self.assertIn("the third wall is missing", self.refused())

    def test_a_mark_that_the_command_refuses(self):
        add_probes(*PLACES)
        bpy.data.lights["point"]["mode"] = "dim"
        self.assertIn('"dim"', self.refused())

    def test_the_folder_of_the_output_is_missing(self):
        add_probes(*PLACES)
        self.settings.output = str(self.folder / "none/scene.probes")
        self.assertIn("there is no folder", self.refused())

    def test_the_output_is_a_folder(self):
        add_probes(*PLACES)
        taken = self.folder / "taken.probes"
        (taken / "full").mkdir(parents=True)
        for chosen in (str(self.folder), f"{self.folder}/", "/", str(taken)):
            self.settings.output = chosen
            self.assertIn(f"{chosen} is a folder: name a file in it", self.refused())
        self.assertEqual(self.files(), ["scene.probes", "taken.probes"])

    def test_there_is_no_output_yet(self):
        for output in ("", "//scene.probes"):
            with self.subTest(output):
                self.settings.output = output
                self.assertIn("save the .blend file", self.refused())


class Arguments(BakeTest):
    def test_no_shell_reads_them(self):
        """Names with all characters that shells read are names of files, and nothing else."""
        add_probes(*PLACES)
        self.output = self.folder / "a b;touch pwned;$(touch pwned)`touch pwned`'\".probes"
        self.settings.output = str(self.output)
        self.bake()
        self.assertEqual(self.files(), [self.output.name])

    def test_no_folder_is_left_of_a_bake_that_did_not_start(self):
        bake = CommandBake("tetralight", BakeSettings())
        self.assertIsInstance(bake, Bake)
        bake.cancel()
        self.assertFalse(bake.scene.parent.exists())


def programs_with(folder):
    """Programs whose arguments name a folder."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            arguments = (process / "cmdline").read_bytes()
        except OSError:
            continue
        if str(folder).encode() in arguments:
            found.append(process.name)
    return found
