# SPDX-License-Identifier: Apache-2.0
"""Lightmaps and reflection probes that the command bakes of the courtyard."""
import unittest

import numpy as np

import tetralight
from support import baked


class Lightmaps(unittest.TestCase):
    def setUp(self):
        path = baked("lightmap", ".lightmaps", "--samples", "1", "--texels-per-meter", "1")
        self.lightmaps = tetralight.open_lightmaps(path)

    def test_rectangles_lie_in_their_pages(self):
        places = self.lightmaps.rectangles()
        self.assertEqual(len(places), self.lightmaps.instance_count)
        lit = places[places["page"] != tetralight.NO_PAGE]
        self.assertGreater(len(lit), 0)
        self.assertLess(lit["page"].max(), self.lightmaps.page_count)
        self.assertGreaterEqual(lit["offset"].min(), 0)
        self.assertLessEqual((lit["offset"] + lit["scale"]).max(), 1 + 1e-5)

    def test_samples_are_the_texels_at_their_centers(self):
        texels = self.lightmaps.irradiance
        size = self.lightmaps.page_size
        self.assertEqual(texels.shape, (self.lightmaps.page_count, size, size, 4))
        rows, columns = np.nonzero(texels[0, ..., 3] > 0)
        chosen = np.random.default_rng(1).choice(len(rows), 20)
        at = np.stack([columns[chosen], rows[chosen]], -1)
        sampled = self.lightmaps.sample(0, (at + 0.5) / size)
        expected = texels[0, at[:, 1], at[:, 0], :3].astype(np.float32) * self.lightmaps.scale
        np.testing.assert_allclose(sampled, expected, 1e-2, 1e-3 * expected.max())

    def test_masks_lie_between_0_and_1(self):
        uv = np.random.default_rng(1).uniform(size=(5, 4, 2))
        mask, openness = self.lightmaps.shadow_mask(0, uv), self.lightmaps.ambient_occlusion(0, uv)
        self.assertEqual((mask.shape, openness.shape), ((5, 4, 4), (5, 4)))
        for values in (mask, openness):
            self.assertTrue(((values >= 0) & (values <= 1)).all())

    def test_refuses_wrong_places(self):
        with self.assertRaisesRegex(tetralight.BadValue, r"uv_page.*\(…, 2\).*\(3,\)"):
            self.lightmaps.sample(0, (0, 0, 0))
        with self.assertRaises(tetralight.NotThere):
            self.lightmaps.sample(1000, (0.5, 0.5))

    def test_close(self):
        texels = self.lightmaps.irradiance
        expected = np.array(texels)
        with self.lightmaps:
            pass
        np.testing.assert_array_equal(texels, expected)
        with self.assertRaises(tetralight.Closed):
            self.lightmaps.sample(0, (0.5, 0.5))

    def test_open_from_bytes(self):
        with open(self.lightmaps.name, "rb") as file:
            again = tetralight.open_lightmaps(file.read())
        np.testing.assert_array_equal(again.irradiance, self.lightmaps.irradiance)


    def test_places_that_are_not_finite_are_named(self):
        uv = np.full((2, 3, 2), 0.5)
        uv[1, 2, 0] = np.nan
        with self.assertRaisesRegex(tetralight.BadValue, r"uv_page\[1, 2\]: .*\[nan, 0.5\]"):
            self.lightmaps.sample(0, uv)
        with self.assertRaisesRegex(tetralight.BadValue, r"normals: .*nan"):
            self.lightmaps.sample(0, (0.5, 0.5), (0, 1, 0), (0, np.nan, 1))
        for pages in (0.5, "a", None, -1):
            with self.assertRaisesRegex(tetralight.BadValue, "pages"):
                self.lightmaps.sample(pages, (0.5, 0.5))


class Reflections(unittest.TestCase):
    def setUp(self):
        path = baked("reflect", ".ktx2", "--samples", "1", "--cube-size", "16")
        self.reflections = tetralight.open_reflections(path)

    def test_texels(self):
        r = self.reflections
        for level in range(r.level_count):
            side = max(1, r.size >> level)
            self.assertEqual(r.texels(level).shape, (r.probe_count, 6, side, side, 4))
        with self.assertRaises(tetralight.NotThere):
            r.texels(r.level_count)

    def test_probes(self):
        probes = self.reflections.probes()
        self.assertEqual(len(probes), self.reflections.probe_count)
        axes = probes["axes"].astype(float)
        np.testing.assert_allclose(axes @ axes.transpose(0, 2, 1), np.tile(np.eye(3), (len(axes), 1, 1)), 0, 1e-5)

    def test_refuses_wrong_arguments(self):
        up = (0, 1, 0)
        for name, call in {
            "level": lambda: self.reflections.texels(0.5),
            r"positions\[1\]": lambda: self.reflections.sample([up, (0, np.inf, 0)], [up, up]),
            "directions": lambda: self.reflections.sample(up, (0, 0, np.nan)),
            "roughness: .*1.5": lambda: self.reflections.sample([up, up], [up, up], (1, 1.5)),
        }.items():
            with self.subTest(name), self.assertRaisesRegex(tetralight.BadValue, name):
                call()

    def test_samples_of_a_constant_sky_are_its_radiance(self):
        """The courtyard has no reflection probe: its only cube is the sky, which is constant."""
        directions = np.random.default_rng(1).normal(size=(5, 4, 3))
        directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
        sky = self.reflections.texels(0)[0, 0, 0, 0, :3].astype(np.float32)
        for roughness in (0, 0.5, 1):
            sampled = self.reflections.sample(np.ones((5, 4, 3)), directions, roughness)
            np.testing.assert_allclose(sampled, np.broadcast_to(sky, (5, 4, 3)), 2e-3)

    def test_open_from_bytes(self):
        with open(self.reflections.name, "rb") as file:
            again = tetralight.open_reflections(file.read())
        np.testing.assert_array_equal(again.texels(), self.reflections.texels())
