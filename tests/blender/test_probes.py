# SPDX-License-Identifier: Apache-2.0
"""Balls that show probes: their places, and their colours against the answers of `tetralight query`."""
import math
import struct

import bpy
import numpy
from blender_test import BlenderTest, add_lamp, add_plane, add_probes, command
from tetralight.probe_file import Probes, basis, read_probes
from tetralight.show_probes import ATTRIBUTE, COLLECTION, ball, gltf_from_blender, show_probes, shown_probes

PLACES = [(x, y, z) for x in (-1, 1.5) for y in (-1, 1) for z in (1, 2)]
LARGE = 3000  # more probes than smooth balls


class BakedTest(BlenderTest):
    def setUp(self):
        super().setUp()
        add_plane()
        add_lamp("POINT", 500, location=(2, 0, 3), color=(1, 0.6, 0.3)).data.tetralight_mode = "BAKED"
        add_probes(*PLACES)
        bpy.ops.tetralight.bake()

    def shown(self):
        """Centres and vertices of the balls, and the colours of the vertices."""
        thing = shown_probes(bpy.context.scene)
        vertices = numpy.empty(len(thing.data.vertices) * 3)
        thing.data.vertices.foreach_get("co", vertices)
        colors = numpy.empty(len(thing.data.vertices) * 4)
        thing.data.color_attributes[ATTRIBUTE].data.foreach_get("color", colors)
        vertices = vertices.reshape(len(PLACES), -1, 3)
        return vertices.mean(axis=1), vertices, colors.reshape(len(PLACES), -1, 4)


class Balls(BakedTest):
    def test_they_are_at_the_probes(self):
        centers = self.shown()[0]
        expected = sorted(PLACES)
        numpy.testing.assert_allclose(sorted(map(tuple, centers.round(4))), expected, atol=1e-4)

    def test_a_vertex_has_the_light_of_its_normal(self):
        centers, vertices, colors = self.shown()
        largest = colors[:, :, :3].max()
        self.assertGreater(largest, 1)
        for center, corners, shown in zip(centers, vertices, colors):
            x, y, z = center
            coefficients = numpy.array(self.irradiance_sh(self.output, (x, z, -y)))
            normals = gltf_from_blender((corners - center) / self.settings.ball_radius)
            expected = numpy.maximum(basis(normals) @ coefficients, 0) / math.pi
            numpy.testing.assert_allclose(shown[:, :3], expected, atol=2e-4 * largest)
            numpy.testing.assert_array_equal(shown[:, 3], 1)

    def test_exposure_and_radius(self):
        _, _, before = self.shown()
        self.settings.exposure = 2
        self.settings.ball_radius = 0.25
        bpy.ops.tetralight.show_probes(filepath=str(self.output))
        centers, vertices, after = self.shown()
        numpy.testing.assert_allclose(after[:, :, :3], 4 * before[:, :, :3], rtol=1e-5)
        numpy.testing.assert_allclose(numpy.linalg.norm(vertices - centers[:, None], axis=2), 0.25, atol=1e-5)

    def test_they_replace_each_other(self):
        before = len(bpy.data.meshes)
        for _ in range(2):
            bpy.ops.tetralight.show_probes(filepath=str(self.output))
        collection = bpy.data.collections[COLLECTION]
        self.assertEqual(len(collection.objects), 1)
        self.assertTrue(collection.hide_render)
        self.assertEqual(len(bpy.data.meshes), before)
        self.assertEqual(len(bpy.data.materials), 1)
        bpy.ops.tetralight.hide_probes()
        self.assertIsNone(shown_probes(bpy.context.scene))
        self.assertEqual(len(bpy.data.meshes), before - 1)

    def test_they_stay_away_if_the_user_wants_that(self):
        bpy.ops.tetralight.hide_probes()
        self.settings.shows_probes = False
        bpy.ops.tetralight.bake()
        self.assertIsNone(shown_probes(bpy.context.scene))

    def test_the_mesh_is_valid(self):
        mesh = shown_probes(bpy.context.scene).data
        self.assertFalse(mesh.validate(verbose=True))


class NoBalls(BlenderTest):
    def test_a_volume_without_probes_shows_an_empty_mesh(self):
        none = Probes(numpy.zeros((0, 3)), numpy.zeros((0, 9, 3)))
        shown = show_probes(bpy.context.scene, none, "none", 0.1, 0)
        self.assertEqual(len(shown.data.vertices), 0)


class Ball(BlenderTest):
    def test_triangles_face_outwards_and_close_the_ball(self):
        for rings in (1, 2, 3):
            with self.subTest(rings):
                normals, faces = ball(rings)
                corners = normals[faces]
                across = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
                self.assertTrue((numpy.einsum("fi,fi->f", across, corners.mean(axis=1)) > 0).all())
                edges = {(a, b) for face in faces for a, b in zip(face, numpy.roll(face, -1))}
                self.assertEqual(len(edges), 3 * len(faces))
                self.assertEqual({(b, a) for a, b in edges}, edges)


class Files(BakedTest):
    def refused(self, data):
        path = self.folder / "bad.probes"
        path.write_bytes(data)
        before = shown_probes(bpy.context.scene)
        error = self.refusal(bpy.ops.tetralight.show_probes, filepath=str(path))
        self.assertEqual(shown_probes(bpy.context.scene), before)
        return error

    def test_files_that_are_not_volumes(self):
        for data in (b"", b"TETRAPV\n", b"x" * 500):
            self.assertIn("not a probe volume", self.refused(data))

    def test_a_missing_file(self):
        error = self.refusal(bpy.ops.tetralight.show_probes, filepath=str(self.folder / "none.probes"))
        self.assertIn("none.probes", error)

    def test_another_version(self):
        data = bytearray(self.output.read_bytes())
        data[8] = 7
        self.assertIn("version of the probe volume is 7", self.refused(data))

    def test_files_that_were_cut_off(self):
        data = self.output.read_bytes()
        for size in range(0, len(data), max(1, len(data) // 50)):
            with self.assertRaises(ValueError):
                self.read(data[:size])

    def test_changed_bytes_are_refused_or_read_whole(self):
        """The reader checks no checksums: changed numbers are other numbers, and nothing else happens."""
        data = self.output.read_bytes()
        for place in range(0, min(len(data), 4096)):
            changed = bytearray(data)
            changed[place] ^= 0xFF
            try:
                probes = self.read(bytes(changed))
            except ValueError:
                continue
            self.assertEqual(probes.coefficients.shape, (len(probes), 9, 3))

    def read(self, data):
        path = self.folder / "changed.probes"
        path.write_bytes(data)
        return read_probes(path)

    def test_a_volume_without_light_has_black_balls(self):
        groups = self.folder / "groups.json"
        groups.write_text('{"groups": [{"name": "line", "positions": [[0, 0, 0], [1, 2, 3]]}]}')
        command("tetrahedralize", groups, "-o", self.output)
        probes = read_probes(self.output)
        self.assertEqual(sorted(map(tuple, probes.positions)), [(0, 0, 0), (1, 2, 3)])
        self.assertEqual(probes.coefficients.max(initial=0), 0)

    def test_compact_probes_have_the_light_of_full_ones(self):
        full = read_probes(self.output)
        data = bytearray(self.output.read_bytes())
        count, = struct.unpack_from("<I", data, 12)
        for i in range(count):
            if data[64 + 64 * i :].startswith(b"irradiance\0"):
                data[64 + 64 * i] = ord("X")  # an unknown section
        compact = self.read(bytes(data))
        scale = numpy.abs(full.coefficients).max()
        numpy.testing.assert_allclose(compact.coefficients, full.coefficients, atol=2e-3 * scale)
        self.assertFalse((compact.coefficients == full.coefficients).all())

    def test_many_probes(self):
        places = [[i % 15, i // 15 % 15, i // 225] for i in range(LARGE)]
        groups = self.folder / "groups.json"
        groups.write_text(f'{{"groups": [{{"name": "many", "positions": {places}}}]}}')
        command("tetrahedralize", groups, "-o", self.output)
        bpy.ops.tetralight.show_probes(filepath=str(self.output))
        self.assertEqual(len(shown_probes(bpy.context.scene).data.vertices), 6 * LARGE)
