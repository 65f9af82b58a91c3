# SPDX-License-Identifier: Apache-2.0
import os
import subprocess
import threading
import unittest

import numpy as np

import tetralight
from support import baked, run_command, temporary_path, vector_path


class Recombine(unittest.TestCase):
    def setUp(self):
        self.volume = tetralight.open(vector_path("layers"))

    def weights(self, value):
        return np.full(len(self.volume.layers), value, np.float32)

    def test_is_linear(self):
        self.volume.recombine(self.weights(1))
        one = self.volume.irradiance
        self.volume.recombine(self.weights(3))
        np.testing.assert_allclose(self.volume.irradiance, 3 * one, 1e-5, 1e-6)
        self.assertEqual(set(self.volume.layers.values()), {3.0})

    def test_by_name_keeps_other_weights(self):
        names = list(self.volume.layers)
        self.volume.recombine(self.weights(2))
        self.volume.recombine({names[0]: 0.5})
        self.assertEqual(list(self.volume.layers.values()), [0.5] + [2.0] * (len(names) - 1))

    def test_keeps_arrays_from_before(self):
        of_file, copy_of_file = self.volume.irradiance, np.array(self.volume.irradiance)
        self.volume.recombine(self.weights(2))
        second, copy_of_second = self.volume.irradiance, np.array(self.volume.irradiance)
        self.volume.recombine(self.weights(4))
        np.testing.assert_array_equal(of_file, copy_of_file)
        np.testing.assert_array_equal(second, copy_of_second)
        np.testing.assert_allclose(self.volume.irradiance, 2 * second, 1e-5, 1e-6)

    def test_refuses_wrong_weights(self):
        count = len(self.volume.layers)
        with self.assertRaisesRegex(tetralight.BadValue, rf"weights: .*\({count},\).*\({count + 1},\)"):
            self.volume.recombine(np.ones(count + 1))
        with self.assertRaisesRegex(tetralight.NotThere, "moon"):
            self.volume.recombine(moon=1)
        with self.assertRaises(tetralight.BadValue):
            self.volume.recombine(self.weights(-1))
        with self.assertRaises(tetralight.NotThere):
            tetralight.open(vector_path("space")).recombine([])

    def test_waits_for_queries_in_other_threads(self):
        """Each answer is the light of one of the weights, never of two."""
        positions = np.tile(self.volume.positions[:1], (50_000, 1))
        self.volume.recombine(self.weights(1))
        expected = self.volume.query(positions[0]).sh[0, 0]
        ratios, is_done = set(), threading.Event()

        def ask():
            while not is_done.is_set():
                light = self.volume.query(positions, threads=2).sh[:, 0, 0] / expected
                ratios.add((round(float(light.min()), 1), round(float(light.max()), 1)))

        thread = threading.Thread(target=ask)
        thread.start()
        for step in range(60):
            self.volume.recombine(self.weights(1 + step % 2))
        is_done.set()
        thread.join()
        self.assertLessEqual(ratios, {(1.0, 1.0), (2.0, 2.0)})
        self.assertTrue(ratios)


class Relight(unittest.TestCase):
    def open(self):
        return tetralight.open(baked("bake", ".probes", "--samples", "8", "--layers", "sky,sun,transfer"))

    def test_a_sky_is_linear(self):
        volume = self.open()
        self.assertTrue(volume.can_relight_sky)
        volume.recombine({name: 0 for name in volume.layers if name != "sky"})
        volume.relight(sky=1)
        one = volume.irradiance
        volume.relight(sky=(2, 4, 8))
        np.testing.assert_allclose(volume.irradiance, one * [2, 4, 8], 1e-3, 1e-3 * one.max())

    def test_a_dark_sun_is_none(self):
        volume = self.open()
        self.assertTrue(volume.can_relight_sun)
        positions = volume.positions
        volume.relight(sun_direction=(0.3, -2, 0.1), sun_irradiance=(1, 1, 1))
        lit = volume.irradiance
        volume.relight(sun_direction=(0.3, -2, 0.1), sun_irradiance=(0, 0, 0))
        dark = volume.irradiance
        volume.recombine(sun=0)
        np.testing.assert_allclose(volume.irradiance, dark, 1e-3, 1e-4)
        self.assertGreater(lit[:, 0].mean(), dark[:, 0].mean())
        np.testing.assert_array_equal(positions, volume.positions)

    def test_is_saved(self):
        volume = self.open()
        volume.relight(sky=3)
        path = temporary_path("relit.probes")
        volume.save(path)
        np.testing.assert_allclose(tetralight.open(path).irradiance, volume.irradiance, 1e-3, 1e-3)

    def test_is_recorded(self):
        volume = self.open()
        baked_with = volume.metadata
        volume.recombine(sun=0.5)
        self.assertEqual(volume.metadata, baked_with)
        volume.relight(sky=3)
        self.assertEqual(volume.metadata, {**baked_with, "relit": "tetralight_relight_sky"})
        volume.relight(sky=2, sun_direction=(0, -1, 0), sun_irradiance=(1, 1, 1))
        self.assertEqual(volume.metadata["relit"], "tetralight_relight_sky tetralight_relight_sun")

    def test_is_not_taken_for_the_light_of_the_scene(self):
        volume, path, scene = self.open(), temporary_path("dusk.probes"), os.environ["TETRALIGHT_COURTYARD"]
        volume.relight(sky=3)
        volume.save(path)
        for check in (["verify", scene, path], ["check-leaks", path, "--scene", scene]):
            with self.assertRaises(subprocess.CalledProcessError) as failed:
                run_command(*check, "--quiet")
            self.assertEqual(failed.exception.returncode, 1)
            self.assertIn("the volume was relit: its light is not that of the scene", failed.exception.stderr)
        again = run_command("bake", scene, "--samples", 8, "--layers", "sky,sun,transfer", "--reuse", path,
                            "-o", temporary_path("again.probes"))
        self.assertIn("relit with \"tetralight_relight_sky\"", again.stderr)

    def test_refuses_wrong_light(self):
        volume = self.open()
        for name, light in {
            "sky": {"sky": np.ones((4, 4))},
            "sun_irradiance": {"sun_direction": (0, -1, 0)},
            "sun_direction": {"sun_direction": (0, -1), "sun_irradiance": (1, 1, 1)},
            "sun_direction: expected a direction": {"sun_direction": (0, 0, 0), "sun_irradiance": (1, 1, 1)},
            r"sun_irradiance: .*\[1, -1, 1\]": {"sun_direction": (0, -1, 0), "sun_irradiance": (1, -1, 1)},
        }.items():
            with self.assertRaisesRegex(tetralight.BadValue, name):
                volume.relight(**light)

    def assert_neither_changes(self, volume, error, **light):
        before, metadata = np.array(volume.irradiance), volume.metadata
        positions = volume.positions[:10]
        answers = volume.query(positions).sh
        with self.assertRaises(error):
            volume.relight(**light)
        np.testing.assert_array_equal(volume.irradiance, before)
        np.testing.assert_array_equal(volume.query(positions).sh, answers)
        self.assertEqual(volume.metadata, metadata)

    def test_changes_sky_and_sun_or_neither(self):
        volume = self.open()
        for irradiance in ((1, -1, 1), (1, 1), "a", (1, 1, np.nan), (1e31, 0, 0)):
            self.assert_neither_changes(
                volume, tetralight.BadValue, sky=5, sun_direction=(0, -1, 0), sun_irradiance=irradiance
            )
        for sky in ("a", (1, 2), np.inf, 1e31):
            self.assert_neither_changes(
                volume, tetralight.BadValue, sky=sky, sun_direction=(0, -1, 0), sun_irradiance=(1, 1, 1)
            )

    def test_changes_no_sky_where_the_sun_cannot_move(self):
        volume = tetralight.open(baked("bake", ".probes", "--samples", "8", "--layers", "sky,transfer"))
        self.assertEqual((volume.can_relight_sky, volume.can_relight_sun), (True, False))
        sun = {"sun_direction": (0, -1, 0), "sun_irradiance": (1, 1, 1)}
        self.assert_neither_changes(volume, tetralight.NotThere, sky=5, **sun)
        volume.relight(sky=5)

    def test_takes_directions_of_any_length(self):
        volume = self.open()
        volume.relight(sun_direction=(0.6, -0.8, 0), sun_irradiance=(1, 1, 1))
        light = volume.irradiance
        for length in (1e-30, 1e25):
            volume.relight(sun_direction=(0.6 * length, -0.8 * length, 0), sun_irradiance=(1, 1, 1))
            np.testing.assert_allclose(volume.irradiance, light, 1e-5, 1e-6)
        with self.assertRaises(tetralight.NotThere):
            tetralight.open(vector_path("space")).relight(sky=1)


class Lights(unittest.TestCase):
    def test_are_those_of_the_scene(self):
        volume = tetralight.open(baked("bake", ".probes", "--samples", "8", "--layers", "sky,sun,transfer"))
        lights = volume.lights
        self.assertIn("directional", {light.type for light in lights})
        for light in lights:
            self.assertAlmostEqual(float(np.linalg.norm(light.direction)), 1, 4)
            self.assertIn(light.mode, ("mixed", "baked", "realtime"))
        self.assertEqual(tetralight.open(vector_path("space")).lights, [])
