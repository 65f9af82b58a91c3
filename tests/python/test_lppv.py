# SPDX-License-Identifier: Apache-2.0
import unittest

import numpy as np

import tetralight
from support import vector_path
from tetralight import sh


class ProxyVolume(unittest.TestCase):
    def setUp(self):
        self.volume = tetralight.open(vector_path("space"))

    def test_texels_are_the_light_at_the_grid_points(self):
        texture = self.volume.lppv((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5), (2, 3, 4))
        self.assertEqual(texture.shape, (4, 3, 2 * 7, 4))
        slabs = texture.slabs
        self.assertEqual(slabs.shape, (7, 4, 3, 2, 4))
        z, y, x = np.meshgrid(*((np.arange(n) + 0.5) / n - 0.5 for n in (4, 3, 2)), indexing="ij")
        expected = self.volume.query(np.stack([x, y, z], -1)).sh
        coefficients = sh.from_packed(np.moveaxis(slabs, 0, -2))
        np.testing.assert_allclose(coefficients, expected, 0, 1e-4 * abs(expected).max())

    def test_follows_the_transform_of_the_object(self):
        moved = np.eye(4)
        moved[:3, 3] = 0.25, -0.5, 0.125
        a = self.volume.lppv((-0.5,) * 3, (0.5,) * 3, (2, 2, 2), world_from_box=moved)
        b = self.volume.lppv((-0.25, -1, -0.375), (0.75, 0, 0.625), (2, 2, 2))
        np.testing.assert_allclose(a, b, 0, 1e-4 * abs(b).max())
        self.assertEqual(a.constants["local_from_world"].shape, (16,))

    def test_layouts_and_formats(self):
        texture = self.volume.lppv((0, 0, 0), (1, 1, 1), (2, 2, 2), layout="four_slabs", format="half", quality="low")
        self.assertEqual((texture.shape, texture.dtype), ((2, 2, 8, 4), np.float16))

    def test_refuses_wrong_boxes(self):
        box = {"low": (0, 0, 0), "high": (1, 1, 1), "resolution": (2, 2, 2)}
        for name, wrong in {
            "low": (0, 0),
            "resolution": (2, 2, 0),
            "world_from_box": np.eye(3),
            "layout": "one",
        }.items():
            with self.subTest(name), self.assertRaisesRegex(tetralight.BadValue, name):
                self.volume.lppv(**{**box, name: wrong})
        with self.assertRaises(tetralight.BadValue):
            self.volume.lppv(**{**box, "resolution": (300, 1, 1)})
        with self.assertRaises(tetralight.BadValue):  # not 2, as 32 bits would read it
            self.volume.lppv(**{**box, "resolution": (2**32 + 2, 1, 1)})
