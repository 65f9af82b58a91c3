# SPDX-License-Identifier: Apache-2.0
import struct
import unittest
import zlib

import numpy as np

import tetralight
from support import temporary_path, vector_path
from tetralight import picture


def read_png(content):
    """The pixels of a file without filters and interlacing; checks each chunk."""
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = [], 8
    while at < len(content):
        (length,) = struct.unpack_from(">I", content, at)
        kind, data = content[at + 4 : at + 8], content[at + 8 : at + 8 + length]
        assert struct.unpack_from(">I", content, at + 8 + length)[0] == zlib.crc32(kind + data)
        chunks.append((kind, data))
        at += 12 + length
    width, height, depth, color = struct.unpack_from(">IIBB", chunks[0][1])
    assert depth == 8 and chunks[-1] == (b"IEND", b"")
    channels = {0: 1, 2: 3, 6: 4}[color]
    rows = np.frombuffer(zlib.decompress(b"".join(d for k, d in chunks if k == b"IDAT")), np.uint8)
    rows = rows.reshape(height, 1 + width * channels)
    assert not rows[:, 0].any()
    return rows[:, 1:].reshape(height, width, channels)


class Png(unittest.TestCase):
    def test_round_trip(self):
        for shape in ((5, 7, 3), (1, 1, 4), (3, 9, 1)):
            pixels = np.random.default_rng(1).integers(0, 256, shape, np.uint8)
            given = pixels[..., 0] if shape[2] == 1 else pixels
            np.testing.assert_array_equal(read_png(picture.png(given)), pixels)

    def test_refuses_other_arrays(self):
        for pixels in (np.zeros((2, 2, 2), np.uint8), np.zeros((2, 2, 3)), np.zeros((0, 2), np.uint8)):
            with self.assertRaisesRegex(tetralight.BadValue, "pixels"):
                picture.png(pixels)

    def test_is_written_whole(self):
        path = temporary_path("picture.png")
        tetralight.write_png(path, np.zeros((2, 3, 3), np.uint8))
        with open(path, "rb") as file:
            self.assertEqual(read_png(file.read()).shape, (2, 3, 3))
        with self.assertRaisesRegex(tetralight.NotFound, "no_such_folder"):
            tetralight.write_png(temporary_path("no_such_folder/a.png"), np.zeros((2, 3, 3), np.uint8))


class Probes(unittest.TestCase):
    def test_each_volume_has_a_picture(self):
        for name in ("space", "plane", "line", "point", "empty", "unbaked", "far"):
            with self.subTest(name):
                pixels = read_png(tetralight.open(vector_path(name))._repr_png_())
                self.assertEqual(pixels.shape[1], 640)
                if name != "empty":
                    self.assertGreater(np.ptp(pixels), 30)

    def test_shows_x_to_the_right_and_z_down(self):
        positions = np.array([[0, 0, 0], [1, 0, 0], [0, 0, 1.0]])
        colors = np.array([[0, 0, 0], [255, 0, 0], [0, 0, 255]], np.uint8)
        pixels = picture.probes_from_above(positions, colors, 300).astype(int)
        red = np.argwhere(pixels[..., 0] > 200).mean(0)
        blue = np.argwhere(pixels[..., 2] > 200).mean(0)
        self.assertGreater(red[1], blue[1])
        self.assertGreater(blue[0], red[0])

    def test_higher_probes_hide_lower_ones(self):
        colors = np.array([[255, 0, 0], [0, 255, 0]], np.uint8)
        pixels = picture.probes_from_above(np.array([[0, 2, 0], [0, 1, 0.0]]), colors, 100)
        self.assertGreater(pixels[..., 0].max(), 200)
        self.assertLess(pixels[..., 1].max(), 100)

    def test_many_probes(self):
        positions = np.random.default_rng(1).uniform(size=(200_000, 3))
        pixels = picture.probes_from_above(positions, np.full((200_000, 3), 200, np.uint8), 200)
        self.assertGreater(pixels.mean(), 100)
