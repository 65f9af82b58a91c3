# SPDX-License-Identifier: Apache-2.0
"""Copies and pickles: what holds open files refuses them, and everything else keeps its values."""
import copy
import gc
import pickle
import unittest

import numpy as np

import tetralight
from support import baked, vector_path


def pickled(value):
    return pickle.loads(pickle.dumps(value))


WAYS = {"copy": copy.copy, "deep copy": copy.deepcopy, "pickle": pickled}


class OpenFiles(unittest.TestCase):
    def assert_refused(self, opened, use):
        for name, way in WAYS.items():
            for value in (opened, [opened]) if way is not copy.copy else (opened,):
                with self.subTest(name), self.assertRaises(TypeError) as caught:
                    way(value)
                self.assertRegex(str(caught.exception), f"^{type(opened).__name__}: cannot be copied or pickled")
        gc.collect()
        use(opened)

    def test_volumes(self):
        volume = tetralight.open(vector_path("space"))
        self.assert_refused(volume, lambda volume: volume.query((0, 0, 0)))
        self.assert_refused(volume._contents.handle, lambda handle: volume.query((0, 0, 0)))

    def test_lightmaps(self):
        path = baked("lightmap", ".lightmaps", "--samples", "1", "--texels-per-meter", "1")
        self.assert_refused(tetralight.open_lightmaps(path), lambda lightmaps: lightmaps.sample(0, (0.5, 0.5)))

    def test_reflections(self):
        path = baked("reflect", ".ktx2", "--samples", "1", "--cube-size", "16")
        self.assert_refused(tetralight.open_reflections(path), lambda reflections: reflections.texels())


class Values(unittest.TestCase):
    def each(self, value):
        for name, way in WAYS.items():
            with self.subTest(name):
                yield way(value)

    def setUp(self):
        self.volume = tetralight.open(vector_path("space"))

    def test_arrays_outlive_the_volume(self):
        expected = np.array(self.volume.positions)
        copies = list(self.each(self.volume.positions))
        self.volume = None
        gc.collect()
        for made in copies:
            np.testing.assert_array_equal(made, expected)

    def test_irradiance_is_an_array(self):
        for made in self.each(self.volume.irradiance):
            np.testing.assert_array_equal(made, self.volume.irradiance)
            with self.assertRaisesRegex(TypeError, "only the array that Volume.irradiance gives"):
                made((0, 0, 0), (0, 1, 0))

    def test_proxy_volumes_keep_slabs_and_constants(self):
        texture = self.volume.lppv((0, 0, 0), (1, 1, 1), (2, 3, 4))
        for made in self.each(texture):
            self.assertIsInstance(made, tetralight.Lppv)
            np.testing.assert_array_equal(made.slabs, texture.slabs)
            self.assertEqual(set(made.constants), set(texture.constants))
            for name, value in texture.constants.items():
                np.testing.assert_array_equal(made.constants[name], value)

    def test_a_deep_copy_of_a_proxy_volume_shares_nothing(self):
        texture = self.volume.lppv((0, 0, 0), (1, 1, 1), (2, 3, 4))
        before = texture.constants["params"].copy()
        copy.deepcopy(texture).constants["params"][:] = 7
        np.testing.assert_array_equal(texture.constants["params"], before)

    def test_light(self):
        light = self.volume.query([(0, 0, 0), (1, 0, 0)], format="packed")
        for made in self.each(light):
            np.testing.assert_array_equal(made.irradiance((0, 1, 0)), light.irradiance((0, 1, 0)))
            self.assertEqual((made.format, made.step_count), (light.format, light.step_count))

    def test_grids(self):
        positions = np.arange(6.0).reshape(2, 3)
        for made in self.each(tetralight.Grid(positions, {"a": positions[:1]}, {"coverage": 1})):
            np.testing.assert_array_equal(made.positions, positions)
            self.assertEqual((made.groups["a"].shape, made.report), ((1, 3), {"coverage": 1}))

    def test_errors(self):
        for kind in tetralight.Error.__subclasses__():
            error = kind("what is wrong", "a_code")
            error.field, error.report = "name", {"a": 1}
            for made in self.each(error):
                self.assertIs(type(made), kind)
                self.assertEqual((made.message, made.code, made.field, made.report, str(made)),
                                 ("what is wrong", "a_code", "name", {"a": 1}, "what is wrong"))
