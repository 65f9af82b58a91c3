# SPDX-License-Identifier: Apache-2.0
"""The command, run from Python."""
import json
import os
import signal
import stat
import unittest
import warnings
from pathlib import Path
from unittest import mock

import numpy

import tetralight
from command_case import COURTYARD, CommandCase, processes_with
from tetralight import _jobs

QUICK = {"samples": 16, "bounces": 1}
CORNERS = numpy.array([[x, y, z] for x in (-1.5, 1.5) for y in (0.5, 2.0) for z in (4.0, 6.25)])
# Longer than any test.
ENDLESS = {"samples": 16777216, "bounces": 4}


class Grid(CommandCase):
    def test_has_the_positions_that_the_command_writes(self):
        grid = tetralight.grid(COURTYARD, spacing=5, name="hall", region_size=16)
        path = self.folder / "groups.json"
        tetralight.run("grid", scene=COURTYARD, output=path, spacing=5, name="hall", region_size=16)
        written = {group["name"]: group["positions"] for group in json.loads(path.read_bytes())["groups"]}
        self.assertGreater(len(written), 1)
        self.assertEqual({name: positions.tolist() for name, positions in grid.groups.items()}, written)
        self.assertEqual(grid.positions.tolist(), sum(written.values(), []))
        self.assertEqual(grid.report["probes"], len(grid))
        self.assert_nothing_is_left()

    def test_spacing_may_be_an_array(self):
        self.assertGreater(len(tetralight.grid(COURTYARD, spacing=numpy.float32([5, 9, 5]))),
                           len(tetralight.grid(COURTYARD, spacing=numpy.float32(9))))


class Bake(CommandCase):
    def test_opens_the_bytes_of_the_command(self):
        path, kept = self.folder / "expected.probes", self.folder / "court.probes"
        tetralight.run("bake", scene=COURTYARD, output=path, **QUICK)
        volume = tetralight.bake(COURTYARD, output=kept, **QUICK)
        self.assertEqual(kept.read_bytes(), path.read_bytes())
        self.assertEqual(volume.probe_count, tetralight.open(path).probe_count)
        self.assertEqual(sorted(os.listdir(self.folder)), ["court.probes", "expected.probes", "temporary"])
        self.assert_nothing_is_left()

    def test_positions_are_all_its_probes(self):
        for positions in (CORNERS, CORNERS.astype(numpy.float32), CORNERS.tolist(), numpy.asfortranarray(CORNERS)):
            volume = tetralight.bake(COURTYARD, positions=positions, **QUICK)
            self.assertEqual(sorted(numpy.asarray(volume.positions).tolist()), sorted(CORNERS.tolist()))
        self.assert_nothing_is_left()

    def test_groups_are_added_to_those_of_the_scene(self):
        own = tetralight.bake(COURTYARD, **QUICK).probe_count
        path = self.folder / "more.json"
        path.write_text(json.dumps({"groups": [{"name": "more", "positions": CORNERS.tolist()}]}))
        for groups in ({"a": CORNERS[:4], "b": CORNERS[4:]}, path, [str(path)]):
            self.assertEqual(tetralight.bake(COURTYARD, groups=groups, **QUICK).probe_count, own + len(CORNERS))
        alone = tetralight.bake(COURTYARD, groups={"a": CORNERS}, only_given_groups=True, **QUICK)
        self.assertEqual(alone.probe_count, len(CORNERS))

    def test_a_scene_may_be_bytes(self):
        positions = tetralight.grid(Path(COURTYARD).read_bytes(), spacing=9).positions
        volume = tetralight.bake(Path(COURTYARD).read_bytes(), positions=positions, **QUICK)
        self.assertEqual(volume.probe_count, len(positions))

    def test_reports_progress_up_to_the_end(self):
        seen = []
        tetralight.bake(COURTYARD, samples=2048, progress=lambda fraction, text: seen.append((fraction, text)))
        fractions = [fraction for fraction, _ in seen if fraction is not None]
        self.assertEqual(fractions, sorted(fractions))
        self.assertEqual(fractions[-1], 1.0)
        self.assertTrue(all(isinstance(text, str) and "\n" not in text for _, text in seen))

    def test_an_exception_of_progress_stops_it(self):
        def stop(fraction, text):
            if fraction is not None:
                raise InterruptedError("enough")

        with self.assertRaises(InterruptedError):
            tetralight.bake(COURTYARD, progress=stop, **ENDLESS)
        self.assert_nothing_is_left()


class Checks(CommandCase):
    def test_leaks_of_a_volume_and_of_its_file(self):
        path = self.folder / "court.probes"
        volume = tetralight.bake(COURTYARD, output=path, **QUICK)
        report = tetralight.check_leaks(COURTYARD, path, places=50)
        self.assertEqual(report["places"], 50)
        self.assertEqual(tetralight.check_leaks(COURTYARD, volume, places=50), report)
        self.assertEqual(tetralight.check_leaks(COURTYARD, path.read_bytes(), places=50), report)
        baked = tetralight.bake(COURTYARD, **QUICK)
        self.assertEqual(tetralight.check_leaks(COURTYARD, baked, places=50), report)
        self.assert_nothing_is_left()

    def test_a_limit_raises_an_error_with_the_report(self):
        path = self.folder / "court.probes"
        tetralight.bake(COURTYARD, output=path, **QUICK)
        with self.assertRaises(tetralight.BadValue) as caught:
            tetralight.check_leaks(COURTYARD, path, places=200, max_leak=1e-9)
        self.assertEqual((caught.exception.code, caught.exception.field), ("invalid_argument", "max_leak"))
        self.assertGreater(caught.exception.report["through_walls"]["mean"], 1e-9)

    def test_verify_or_a_command_without_it(self):
        path = self.folder / "court.probes"
        tetralight.bake(COURTYARD, output=path, samples=256)
        if not _jobs.setting_names(_jobs.find_command(), "verify"):
            with self.assertRaises(tetralight.BadValue) as caught:
                tetralight.verify(COURTYARD, path)
            self.assertEqual(caught.exception.field, "command")
            return
        loose = {"max_mean_z": 1e3, "min_within": 0, "max_undecided": 1, "max_interpolation": 1e3,
                 "max_leak_share": 1, "max_unseen_share": 1}
        few = {"probes": 20, "places": 20, "samples": 4096, **loose}
        self.assertIsInstance(tetralight.verify(COURTYARD, path, **few), dict)
        with self.assertRaises(tetralight.BadValue) as caught:
            tetralight.verify(COURTYARD, path, **{**few, "max_interpolation": 1e-9})
        self.assertEqual(caught.exception.field, "max_interpolation")
        self.assertIsInstance(caught.exception.report, dict)


class WrongCalls(CommandCase):
    def assert_refused(self, kind, field, call):
        with self.assertRaises(kind) as caught:
            call()
        self.assertEqual(caught.exception.field, field)
        self.assert_nothing_is_left()

    def test_unknown_keywords_suggest_the_nearest(self):
        for call, near in ((lambda: tetralight.bake(COURTYARD, sample=16), "samples"),
                           (lambda: tetralight.grid(COURTYARD, spaceing=1), "spacing"),
                           (lambda: tetralight.check_leaks(COURTYARD, "a", maxleak=1), "max_leak")):
            with self.assertRaisesRegex(TypeError, f"did you mean '{near}'"):
                call()

    def test_settings_that_are_not_for_bake_name_what_is(self):
        with self.assertRaisesRegex(TypeError, "chunks"):
            tetralight.bake(COURTYARD, resume=True)
        with self.assertRaisesRegex(TypeError, "not both"):
            tetralight.bake(COURTYARD, positions=CORNERS, groups={"a": CORNERS})

    def test_values_that_a_setting_cannot_have(self):
        bake = tetralight.bake
        for field, value in (("samples", "many"), ("samples", 0), ("samples", float("nan")), ("sky", [1, 2]),
                             ("sky", numpy.array([1, 2, numpy.inf])), ("layers", ["sky", "sky"])):
            with self.subTest(field=field, value=value):
                self.assert_refused(tetralight.BadValue, field, lambda: bake(COURTYARD, **{field: value}))
        for value in (object(), {1}, [b"a"]):
            self.assert_refused(tetralight.BadValue, "samples", lambda: bake(COURTYARD, samples=value))

    def test_positions_that_are_none(self):
        bad = CORNERS.copy()
        bad[5, 1] = numpy.nan
        everywhere = numpy.broadcast_to(numpy.float32(0), (10**12, 3))
        for field, value in (("positions[5]", bad), ("positions", CORNERS[0]), ("positions", CORNERS[:, :2]),
                             ("positions", [[1, 2, 3], [1, 2]]), ("positions", [["a", "b", "c"]]),
                             ("positions", CORNERS + 1j), ("positions", everywhere), ("positions", None.__class__)):
            with self.subTest(value=str(value)[:40]):
                self.assert_refused(tetralight.BadValue, field,
                                    lambda: tetralight.bake(COURTYARD, positions=value, **QUICK))

    def test_files_that_are_not_there(self):
        self.assert_refused(tetralight.NotFound, "scene", lambda: tetralight.bake(self.folder / "none.glb", **QUICK))
        output = self.folder / "none" / "a.probes"
        self.assert_refused(tetralight.BadValue, "output", lambda: tetralight.bake(COURTYARD, output=output))
        self.assert_refused(tetralight.BadValue, "output", lambda: tetralight.bake(COURTYARD, output=self.folder))

    def test_arguments_that_are_neither_paths_nor_positions(self):
        bake = tetralight.bake
        for field, call in {"scene": lambda: bake(3), "output": lambda: bake(COURTYARD, output=b"a"),
                            "groups": lambda: bake(COURTYARD, groups=5), "command": lambda: bake(COURTYARD, command=2.5),
                            "progress": lambda: bake(COURTYARD, progress="bar"), "name": lambda: tetralight.run(2.5),
                            "volume": lambda: tetralight.verify(COURTYARD, None)}.items():
            with self.subTest(field):
                self.assert_refused(tetralight.BadValue, field, call)

    def test_a_failure_keeps_the_old_output(self):
        output = self.folder / "court.probes"
        output.write_bytes(b"old")
        with self.assertRaises(tetralight.BadValue):
            tetralight.bake(COURTYARD, output=output, samples=0)
        self.assertEqual(output.read_bytes(), b"old")
        self.assertEqual(sorted(os.listdir(self.folder)), ["court.probes", "temporary"])

    def test_a_failure_of_the_last_copy_leaves_nothing(self):
        output = self.folder / "court.probes"
        with mock.patch("os.replace", side_effect=OSError(28, "No space left on device")):
            with self.assertRaises(tetralight.Unavailable) as caught:
                tetralight.bake(COURTYARD, output=output, **QUICK)
        self.assertEqual(caught.exception.field, "output")
        self.assertEqual(os.listdir(self.folder), ["temporary"])
        self.assert_nothing_is_left()


class Programs(CommandCase):
    def refusal(self, **settings):
        with self.assertRaises(tetralight.Error) as caught:
            tetralight.bake(COURTYARD, **settings)
        self.assert_nothing_is_left()
        return caught.exception

    def test_is_found_by_argument_then_environment_then_path(self):
        named, first = self.program("exit 3"), str(self.folder)
        real = os.environ["TETRALIGHT_COMMAND"]
        self.assertEqual(_jobs.find_command(named), str(named))
        with mock.patch.dict(os.environ, TETRALIGHT_COMMAND=str(named)):
            self.assertEqual(_jobs.find_command(), str(named))
            self.assertEqual(_jobs.find_command(real), real)
        named.rename(self.folder / "tetralight")
        with mock.patch.dict(os.environ, PATH=first):
            del os.environ["TETRALIGHT_COMMAND"]
            self.assertEqual(_jobs.find_command(), str(self.folder / "tetralight"))

    def test_is_missing_or_not_a_program(self):
        text = self.folder / "text"
        text.write_text("hello")
        text.chmod(stat.S_IRUSR)
        for command in (self.folder / "none", text, self.folder):
            error = self.refusal(command=command)
            self.assertEqual((error.code, error.field, error.value), ("not_found", "command", str(command)))
        text.chmod(stat.S_IRWXU)
        self.assertEqual(self.refusal(command=text).code, "unavailable")

    def test_dies(self):
        for script, reason in (("kill -9 $$", "ended by SIGKILL"), ("echo broken >&2; exit 7", "code 7: broken"),
                               ("kill -34 $$", "ended by "), ("exit 0", "code 0, without a message"),
                               ("echo 3", "code 0"), ('echo \'{"output": "x"}\'; exit 1', "code 1"),
                               ("printf '\\377\\376'; exit 1", "code 1")):
            with self.subTest(script=script):
                error = self.refusal(command=self.program(script))
                self.assertEqual(error.code, "command_failed")
                self.assertIn(reason, str(error))

    def test_is_killed_in_the_middle(self):
        def kill(fraction, text):
            for process in processes_with(f"--job {self.temporary}"):
                os.kill(process, signal.SIGKILL)

        error = self.refusal(progress=kill, **ENDLESS)
        self.assertEqual(error.code, "command_failed")
        self.assertIn("SIGKILL", str(error))

    def test_writes_no_volume(self):
        error = self.refusal(command=self.program("echo '{}'"))
        self.assertEqual(error.code, "command_failed")

    def test_each_code_is_an_exception(self):
        for code, kind in _jobs._CLASSES.items():
            answer = json.dumps({"error": {"code": code, "field": "sky", "value": "7", "message": "no"}, "probes": 3})
            error = self.refusal(command=self.program(f"echo '{answer}'; exit 75"))
            self.assertIs(type(error), kind)
            self.assertEqual((error.code, error.field, error.value, str(error)), (code, "sky", "7", "no"))
            self.assertEqual(error.report, {"probes": 3})

    def test_warnings_become_warnings(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            tetralight.run("x", command=self.program("""echo '{"warnings": ["a lamp has no name"]}'"""))
        self.assertEqual([str(warning.message) for warning in caught], ["tetralight x: a lamp has no name"])
        self.assertEqual(caught[0].filename, __file__)


class Interrupts(CommandCase):
    def interrupted_bake(self, more=""):
        process = self.python(
            "import tetralight, os\n"
            f"tetralight.bake({COURTYARD!r}, output='court.probes', samples=16777216, {more}\n"
            "    progress=lambda fraction, text: print(fraction, flush=True))")
        return process

    def test_ctrl_c_leaves_nothing(self):
        process = self.interrupted_bake()
        while process.stdout.readline().strip() == "None":
            pass
        self.assertNotEqual(os.listdir(self.temporary), [])
        code, messages = self.interrupt(process)
        self.assertEqual(messages.strip().splitlines()[-1], "KeyboardInterrupt")
        self.assertEqual(code, -2)
        self.assertEqual(os.listdir(self.folder), ["temporary"])
        self.assert_nothing_is_left()

    def test_a_second_ctrl_c_kills_a_command_that_ignores_it(self):
        ready, asked = self.folder / "ready", self.folder / "asked"
        stubborn = self.program(f"trap 'echo > {asked}' INT; echo > {ready}; while :; do sleep 0.1; done")
        process = self.interrupted_bake(f"command={str(stubborn)!r}, ")
        self.eventually(ready.exists)
        process.send_signal(signal.SIGINT)
        self.eventually(asked.exists)
        self.assertIsNone(process.poll())
        code, messages = self.interrupt(process)
        self.assertIn("KeyboardInterrupt", messages)
        self.assertNotEqual(code, 0)
        self.assert_nothing_is_left()

    def test_a_command_that_ignores_it_is_killed_after_a_time(self):
        stubborn = self.program("trap '' INT; while :; do sleep 0.1; done")
        with mock.patch.object(_jobs, "SECONDS_TO_END", 0.3):
            with self.assertRaises(InterruptedError):
                tetralight.run("x", command=stubborn, progress=self.stop_when_running)
        self.assert_nothing_is_left()

    def stop_when_running(self, fraction, text):
        if any(self.temporary.glob("*/answer.json")):
            raise InterruptedError


if __name__ == "__main__":
    unittest.main()
