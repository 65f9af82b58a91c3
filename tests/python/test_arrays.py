# SPDX-License-Identifier: Apache-2.0
"""The arrays of a volume: views without copies, which keep the memory."""
import gc
import json
import unittest
import weakref
from unittest import mock

import numpy as np

import tetralight
from support import VECTORS, vector_path

NAMES = ("positions", "cells", "neighbors", "irradiance", "validity", "standard_error")


class Arrays(unittest.TestCase):
    def setUp(self):
        self.volume = tetralight.open(vector_path("space"))

    def test_shapes(self):
        probes, cells = self.volume.probe_count, self.volume.cell_count
        shapes = [getattr(self.volume, name).shape for name in NAMES]
        self.assertEqual(shapes, [(probes, 3), (cells, 4), (cells, 4), (probes, 9, 3), (probes,), (probes,)])

    def test_cannot_be_written(self):
        for name in NAMES:
            array = getattr(self.volume, name)
            with self.subTest(name), self.assertRaises(ValueError):
                array[0] = 0
        with self.assertRaises(ValueError):
            self.volume.irradiance.flags.writeable = True

    def test_are_views(self):
        for name in ("positions", "cells", "neighbors", "irradiance"):
            a, b = getattr(self.volume, name), getattr(self.volume, name)
            self.assertTrue(np.shares_memory(a, b), name)
        again = tetralight.open(vector_path("space"))
        self.assertFalse(np.shares_memory(again.positions, self.volume.positions))

    def test_outlive_the_volume(self):
        copies = {name: np.array(getattr(self.volume, name)) for name in NAMES}
        views = {name: getattr(self.volume, name)[1:] for name in NAMES}
        self.volume = None
        gc.collect()
        for name in NAMES:
            np.testing.assert_array_equal(views[name], copies[name][1:])

    def test_free_the_memory_with_the_last_view(self):
        handle = weakref.ref(self.volume._contents.handle)
        view = self.volume.positions[3]
        self.volume = None
        gc.collect()
        self.assertIsNotNone(handle())
        del view
        gc.collect()
        self.assertIsNone(handle())

    def test_close_frees_the_memory_without_views(self):
        handle = weakref.ref(self.volume._contents.handle)
        copy = np.array(self.volume.positions)
        self.volume.close()
        gc.collect()
        self.assertIsNone(handle())
        self.assertEqual(copy.shape, (self.volume.probe_count, 3))

    def test_outlive_close(self):
        positions, irradiance = self.volume.positions, self.volume.irradiance
        expected = np.array(positions), np.array(irradiance)
        with self.volume:
            pass
        np.testing.assert_array_equal(positions, expected[0])
        np.testing.assert_array_equal(irradiance, expected[1])

    def test_are_those_of_the_probes(self):
        """At a probe the light is that of the probe; in half precision."""
        for path in sorted(VECTORS.glob("*.json")):
            text = json.loads(path.read_text())
            volume = tetralight.open(VECTORS / text["volume"])
            if not volume.has_light or path.stem == "far":  # its positions are inexact as floats
                continue
            light = volume.query(volume.positions, walls="ignore")
            with self.subTest(path.stem):
                np.testing.assert_allclose(light.sh, volume.irradiance, 0, 2e-3 * text["largest_light"])

    def test_are_consistent(self):
        """Each neighbor inside the hull has the cell as a neighbor, too, and shares three probes."""
        cells, neighbors = self.volume.cells, self.volume.neighbors
        for cell in range(self.volume.inner_cell_count):
            for other in neighbors[cell]:
                self.assertIn(cell, neighbors[other])
                self.assertEqual(len(set(cells[cell]) & set(cells[other])), 3)

    def test_the_box_holds_the_probes(self):
        np.testing.assert_allclose(self.volume.positions.min(0), self.volume.low, 0, 1e-6)
        np.testing.assert_allclose(self.volume.positions.max(0), self.volume.high, 0, 1e-6)

    def test_of_a_volume_without_light_or_probes(self):
        unbaked = tetralight.open(vector_path("unbaked"))
        self.assertFalse(unbaked.has_light)
        self.assertEqual(unbaked.irradiance.shape, (0, 9, 3))
        empty = tetralight.open(vector_path("empty"))
        self.assertEqual((empty.positions.shape, empty.cells.shape), ((0, 3), (0, 4)))
        self.assertEqual((empty.validity.shape, empty.standard_error.shape), ((0,), (0,)))


class Metadata(unittest.TestCase):
    def test_other_text_than_a_json_object_is_corrupt(self):
        """The library does not parse the text."""
        volume = tetralight.open(vector_path("space"))
        for text in ("{", "[1]", "5", "[" * 100_000):
            with self.subTest(text[:5]), mock.patch.object(type(volume._contents), "_text", lambda *_: text):
                with self.assertRaisesRegex(tetralight.Corrupt, "metadata: not "):
                    volume.metadata
        with mock.patch.object(type(volume._contents), "_text", lambda *_: ""):
            self.assertEqual(volume.metadata, {})


class Irradiance(unittest.TestCase):
    def test_can_be_called_with_positions_and_normals(self):
        volume = tetralight.open(vector_path("space"))
        positions = np.random.default_rng(1).uniform(-1, 1, (50, 3))
        up = (0, 1, 0)
        expected = volume.query(positions, outside="clamp").irradiance(up)
        np.testing.assert_array_equal(volume.irradiance(positions, up, outside="clamp"), expected)
        with self.assertRaises(TypeError):
            (volume.irradiance + 1)(positions, up)


class Closing(unittest.TestCase):
    def test_calls_fail_after_close(self):
        with tetralight.open(vector_path("layers")) as volume:
            irradiance = volume.irradiance
        self.assertTrue(volume.is_closed)
        for call in (
            lambda: volume.positions,
            lambda: volume.query((0, 0, 0)),
            lambda: volume.layers,
            lambda: volume.recombine(),
            lambda: volume.picture(),
            lambda: irradiance((0, 0, 0), (0, 1, 0)),
        ):
            with self.assertRaisesRegex(tetralight.Closed, "layers.probes"):
                call()
        volume.close()
        self.assertIn("closed", repr(volume))
        self.assertIsNone(volume._repr_png_())


class Bytes(unittest.TestCase):
    def test_open_as_files_do(self):
        with open(vector_path("space"), "rb") as file:
            content = bytearray(file.read())
        expected = tetralight.open(vector_path("space"))
        for given in (bytes(content), content, memoryview(content)):
            volume = tetralight.open(given)
            content[-1] ^= 1  # the bytes were copied
            np.testing.assert_array_equal(volume.irradiance, expected.irradiance)
            content[-1] ^= 1

    def test_corrupt_ones_are_refused(self):
        with self.assertRaises(tetralight.Error):
            tetralight.open(b"")
        with self.assertRaises(tetralight.Corrupt):
            with open(vector_path("space"), "rb") as file:
                tetralight.open(file.read()[:-1])
