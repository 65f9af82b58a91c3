# SPDX-License-Identifier: Apache-2.0
"""Wrong arguments: messages name the argument, what was expected and what was given."""
import os
import tempfile
import unittest
import warnings

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
        self.refused("rendering_layers", "uint32", "0.5", rendering_layers=0.5)
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


NOT_NUMBERS = ("two", None, [1], {}, b"2", object(), True, np.zeros(2), 1j, float("nan"), 10**400, set())
NOT_VECTORS = ("two", [1], (1, 2, 3, 4), {}, b"2", object(), True, (1, None, 2), ["a"] * 3, [[1], [1, 2]], [10**400] * 3)


class Types(unittest.TestCase):
    """Values of wrong types and lengths: the error names the argument and the value."""

    def assert_refused(self, name, call, values):
        for value in values:
            with self.subTest(name, value=value), self.assertRaises(tetralight.BadValue) as caught:
                call(value)
            self.assertRegex(caught.exception.message, f"^{name}[:\\[].*given ")
            self.assertEqual(len(caught.exception.message.splitlines()), 1)

    def query(self, **arguments):
        return tetralight.open(vector_path("space")).query(np.zeros((5, 3)), **arguments)

    def test_numbers_of_a_query(self):
        for name in ("threads", "fade_distance", "normal_offset"):
            values = [value for value in NOT_NUMBERS if value is not None or name != "threads"]
            self.assert_refused(name, lambda value: self.query(**{name: value}), values)
        self.assert_refused("threads", lambda value: self.query(threads=value), (2.5, 0, -1, 2**40))

    def test_choices(self):
        for name in ("format", "outside", "walls"):
            self.assert_refused(name, lambda value: self.query(**{name: value}), ([], {}, 1, None, "", np.zeros(3)))

    def test_arrays_of_a_query(self):
        volume = tetralight.open(vector_path("space"))
        self.assert_refused("positions", volume.query, (*NOT_VECTORS, None))
        for name in ("normals", "radii", "rendering_layers"):
            values = [value for value in NOT_VECTORS if value is not None]
            self.assert_refused(name, lambda value: self.query(**{name: value}), values)

    def test_weights(self):
        volume = tetralight.open(vector_path("layers"))
        before = volume.layers
        name = next(iter(before))
        self.assert_refused("weights", volume.recombine, [[value] * len(before) for value in ("a", None, -1, 1e300)])
        self.assert_refused("weights", volume.recombine, ("two", 1, [1], object()))
        self.assert_refused(r"weights\['%s'\]" % name, lambda value: volume.recombine({name: value}), NOT_NUMBERS)
        self.assertEqual(volume.layers, before)
        with self.assertRaisesRegex(tetralight.NotThere, "layer 1; layers: sun"):
            volume.recombine({1: 1, "sun": 1})

    def test_proxy_volumes(self):
        volume = tetralight.open(vector_path("space"))
        box = {"low": (0, 0, 0), "high": (1, 1, 1), "resolution": (2, 2, 2)}
        for name in box:
            self.assert_refused(name, lambda value: volume.lppv(**{**box, name: value}), (*NOT_VECTORS, None))
        self.assert_refused("world_from_box", lambda value: volume.lppv(**box, world_from_box=value), NOT_VECTORS)
        for name in ("quality", "placement", "layout", "format"):
            self.assert_refused(name, lambda value: volume.lppv(**box, **{name: value}), ([], {}, 1, None, "x"))

    def test_pictures(self):
        volume = tetralight.open(vector_path("space"))
        self.assert_refused("width", volume.picture, (2.5, "two", None, 15, 2**40))
        self.assert_refused("light", tetralight.tone_mapped, NOT_VECTORS)
        self.assert_refused("pixels", lambda value: tetralight.write_png(temporary_path("a.png"), value), NOT_VECTORS)

    def test_paths(self):
        volume = tetralight.open(vector_path("space"))
        for write in (volume.save, volume.to_vtu):
            self.assert_refused("path", write, (2.5, None, [], "", b"name", "a\0b", "\ud800"))
        for open_file in (tetralight.open, tetralight.open_lightmaps, tetralight.open_reflections):
            self.assert_refused("source", open_file, (2.5, None, [], ""))

    def test_clients(self):
        address = "http://127.0.0.1:1"
        client = tetralight.Client(address, retry_seconds=0)
        for name in ("timeout", "retry_seconds"):
            self.assert_refused(name, lambda value: tetralight.Client(address, **{name: value}), (*NOT_NUMBERS, -1))
        query = client.query
        self.assert_refused("fade_distance", lambda value: query("a", [[0, 0, 0]], fade_distance=value), ("1", [], -1, 0))
        self.assert_refused("positions", lambda value: query("a", value), NOT_VECTORS)
        self.assert_refused("kind", lambda value: client.upload(value, b""), (2.5, [], None))
        self.assert_refused("source", lambda value: client.upload("scenes", value), (2.5, 1, None))
        for value in (2.5, None, [], ""):
            with self.subTest(value=value), self.assertRaisesRegex(tetralight.BadValue, "name: .*an id or a name"):
                query(value, [[0, 0, 0]])
            with self.subTest(value=value), self.assertRaisesRegex(tetralight.BadValue, "url"):
                tetralight.Client(value)

    def test_large_numbers_give_no_warning(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            light = tetralight.open(vector_path("space")).query([[1e300, 0, 0]])
        self.assertEqual(light.not_finite_count, 1)


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


class Written(unittest.TestCase):
    """`save`, which the library writes, and `to_vtu`, which Python writes, do the same with paths."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tetralight_python_")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        volume = tetralight.open(vector_path("space"))
        self.writers = volume.save, volume.to_vtu

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_paths_that_do_not_lead_to_a_file(self):
        os.mkdir(self.path("folder"))
        open(self.path("file"), "w").close()
        os.symlink("loop", self.path("loop"))
        os.symlink("none/a", self.path("dangling"))
        names = sorted(os.listdir(self.folder))
        for name in ("none/a", "file/a", "folder", "loop", "dangling", "a" * 300):
            for write in self.writers:
                with self.subTest(name, write=write.__name__), self.assertRaises(tetralight.NotFound) as caught:
                    write(self.path(name))
                self.assertEqual(caught.exception.code, "bad_file")
                self.assertIn(name[:100], caught.exception.message)
        self.assertEqual(sorted(os.listdir(self.folder)), names)

    def test_a_link_stays(self):
        os.symlink("target", self.path("link"))
        for write in self.writers:
            write(self.path("link"))
            self.assertTrue(os.path.islink(self.path("link")))
            self.assertGreater(os.path.getsize(self.path("target")), 1000)
            os.unlink(self.path("target"))

    def test_pipes_and_devices_are_written_to(self):
        os.mkfifo(self.path("pipe"))
        reader = os.open(self.path("pipe"), os.O_RDONLY | os.O_NONBLOCK)
        self.addCleanup(os.close, reader)
        for write in self.writers:
            write(self.path("pipe"))
            self.assertGreater(len(os.read(reader, 1 << 20)), 1000)

    def test_a_dash_is_a_name(self):
        before = os.getcwd()
        os.chdir(self.folder)
        try:
            for write in self.writers:
                write("-")
                self.assertEqual(os.listdir("."), ["-"])
        finally:
            os.chdir(before)


class Ragged(unittest.TestCase):
    def test_rows_of_different_lengths(self):
        with self.assertRaisesRegex(tetralight.BadValue, r"positions: expected numbers of the shape .*\[\[1, 2, 3\], \[4, 5\]\]"):
            tetralight.open(vector_path("space")).query([[1, 2, 3], [4, 5]])

    def test_rows_of_different_lengths_for_the_service(self):
        with self.assertRaisesRegex(tetralight.BadValue, "positions"):
            tetralight.Client("http://127.0.0.1:1").query("court", [[1, 2, 3], [4, 5]])

    def test_fade_distances_that_are_not_floats(self):
        for fade in (1e300, 0.0, -1.0, float("nan")):
            with self.subTest(fade), self.assertRaisesRegex(tetralight.BadValue, "fade_distance"):
                write_request(np.zeros((1, 3)), 0, "half", "ambient", fade, "hide")
