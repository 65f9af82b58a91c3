# SPDX-License-Identifier: Apache-2.0
"""Wrong arguments: messages name the argument, what was expected and what was given."""
import unittest

import numpy as np

import tetralight
from support import temporary_path, vector_path
from tetralight._query_bytes import write_request


class Arguments(unittest.TestCase):
    def setUp(self):
        self.volume = tetralight.open(vector_path("space"))
        self.positions = np.zeros((5, 3), np.float32)

    def refused(self, *words, **arguments):
        given = {"positions": self.positions, **arguments}
        with self.assertRaises(tetralight.BadValue) as caught:
            self.volume.query(**given)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_positions(self):
        self.refused("positions", "(…, 3)", "(5, 4)", positions=np.zeros((5, 4)))
        self.refused("positions", "()", positions=1.0)
        self.refused("positions", "complex", positions=np.zeros((5, 3), complex))
        self.refused("positions", positions=[["a", "b", "c"]])

    def test_hints(self):
        self.refused("hints", "uint32", "int64", hints=np.zeros(5, np.int64))
        self.refused("hints", "(5,)", "(4,)", hints=np.zeros(4, np.uint32))
        self.refused("hints", "gaps", hints=np.zeros(10, np.uint32)[::2])
        self.refused("hints", "list", hints=[0] * 5)
        read_only = np.zeros(5, np.uint32)
        read_only.flags.writeable = False
        self.refused("hints", "read-only", hints=read_only)

    def test_out(self):
        self.refused("out", "(5, 9, 3)", "(5, 27)", out=np.zeros((5, 27), np.float32))
        self.refused("out", "float32", "float64", out=np.zeros((5, 9, 3)))
        self.refused("out", "gaps", "strides", out=np.zeros((5, 9, 6), np.float32)[:, :, ::2])
        self.refused("out", "follow", "strides", out=np.zeros((5, 9, 3), np.float32)[::-1])
        self.refused("out", "packed", format="packed", out=self.volume.query(self.positions))
        self.refused("out.sh", "(5, 9, 3)", "(4, 9, 3)", out=self.volume.query(self.positions[:4]))

    def test_options(self):
        self.refused("format", "'half'", "'sh'", format="sh")
        self.refused("outside", "'clamp'", "'black'", outside="black")
        self.refused("walls", "'ignore'", walls="")
        self.refused("fade_distance", "0", outside="ambient", fade_distance=0)
        self.refused("normals", "(5, 3)", "(4, 3)", normals=np.zeros((4, 3)))
        self.refused("radii", "(5,)", "(2,)", radii=[0, 1])
        self.refused("radii", "-1", radii=-1)
        self.refused("rendering_layers", "uint32", "float64", rendering_layers=0.5)
        self.refused("rendering_layers", "4294967295", rendering_layers=-1)
        self.refused("threads", "0", threads=0)

    def test_a_refused_query_changes_nothing(self):
        out = np.full((5, 9, 3), 7, np.float32)
        self.refused("outside", outside="black", out=out)
        self.refused("radii", radii=-1, out=out)
        self.assertTrue((out == 7).all())

    def test_normals_of_an_answer(self):
        light = self.volume.query(self.positions)
        with self.assertRaisesRegex(tetralight.BadValue, r"normals: .*\(5, 3\).*\(4, 3\)"):
            light.irradiance(np.zeros((4, 3)))


class Files(unittest.TestCase):
    def test_a_missing_file(self):
        path = temporary_path("missing.probes")
        for open_file in (tetralight.open, tetralight.open_lightmaps, tetralight.open_reflections):
            with self.assertRaisesRegex(tetralight.NotFound, "missing.probes"):
                open_file(path)

    def test_a_corrupt_file(self):
        content = bytearray(open(vector_path("space"), "rb").read())
        content[len(content) // 2] ^= 1
        path = temporary_path("corrupt.probes")
        with open(path, "wb") as file:
            file.write(content)
        with self.assertRaisesRegex(tetralight.Corrupt, "corrupt.probes"):
            tetralight.open(path)

    def test_a_file_of_another_kind(self):
        with self.assertRaises(tetralight.Error):
            tetralight.open(__file__)

    def test_a_path_with_a_zero_byte(self):
        with self.assertRaisesRegex(tetralight.BadValue, "zero bytes"):
            tetralight.open(vector_path("space") + "\0other")
        with self.assertRaisesRegex(tetralight.BadValue, "zero bytes"):
            tetralight.open(vector_path("space")).save(temporary_path("a\0b"))


class Ragged(unittest.TestCase):
    def test_rows_of_different_lengths(self):
        with self.assertRaisesRegex(tetralight.BadValue, "positions: expected the shape"):
            tetralight.open(vector_path("space")).query([[1, 2, 3], [4, 5]])

    def test_rows_of_different_lengths_for_the_service(self):
        with self.assertRaisesRegex(tetralight.BadValue, "positions"):
            tetralight.Client("http://127.0.0.1:1").query("court", [[1, 2, 3], [4, 5]])

    def test_fade_distances_that_are_not_floats(self):
        for fade in (1e300, 0.0, -1.0, float("nan")):
            with self.subTest(fade), self.assertRaisesRegex(tetralight.BadValue, "fade_distance"):
                write_request(np.zeros((1, 3)), 0, "half", "ambient", fade, "hide")
