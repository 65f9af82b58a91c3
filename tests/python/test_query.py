# SPDX-License-Identifier: Apache-2.0
import threading
import unittest

import numpy as np

import tetralight
from support import vector_path
from tetralight import sh


def random_positions(count, seed=1):
    return np.random.default_rng(seed).uniform(-2, 2, (count, 3)).astype(np.float32)


class Query(unittest.TestCase):
    def setUp(self):
        self.volume = tetralight.open(vector_path("space"))

    def assert_same_light(self, a, b):
        np.testing.assert_array_equal(a.sh, b.sh)
        np.testing.assert_array_equal(a.occlusion, b.occlusion)
        np.testing.assert_array_equal(a.cells, b.cells)

    def test_keeps_the_shape_of_the_positions(self):
        light = self.volume.query(random_positions(24).reshape(2, 3, 4, 3))
        self.assertEqual(light.sh.shape, (2, 3, 4, 9, 3))
        self.assertEqual(light.occlusion.shape, (2, 3, 4, 4))
        self.assertEqual(light.cells.shape, (2, 3, 4))
        self.assertEqual(light.irradiance((0, 1, 0)).shape, (2, 3, 4, 3))

    def test_answers_one_position(self):
        position = random_positions(1)
        one, many = self.volume.query(tuple(position[0])), self.volume.query(position)
        self.assertEqual(one.sh.shape, (9, 3))
        np.testing.assert_array_equal(one.sh, many.sh[0])
        self.assertEqual(one.cells, many.cells[0])

    def test_answers_no_positions(self):
        light = self.volume.query(np.empty((0, 3)))
        self.assertEqual((light.sh.shape, len(light)), ((0, 9, 3), 0))
        self.assertEqual(light.irradiance(np.empty((0, 3))).shape, (0, 3))

    def test_is_the_same_for_any_threads(self):
        positions = random_positions(100_000)
        one = self.volume.query(positions, threads=1)
        self.assert_same_light(one, self.volume.query(positions, threads=5))
        self.assertEqual(one.step_count, self.volume.query(positions, threads=3).step_count)

    def test_is_the_same_for_any_type_and_gaps(self):
        positions = random_positions(1000)
        expected = self.volume.query(positions)
        padded = np.zeros((1000, 4), np.float32)
        padded[:, :3] = positions
        for name, given in {
            "doubles": positions.astype(np.float64),
            "rows with gaps": padded[:, :3],
            "columns": np.asfortranarray(positions),
            "backwards": positions[::-1].copy()[::-1],
            "big-endian": positions.astype(">f4"),
            "lists": positions.tolist(),
        }.items():
            with self.subTest(name):
                self.assert_same_light(self.volume.query(given), expected)

    def test_counts_positions_that_are_not_finite(self):
        positions = random_positions(70_000)
        positions[[3, 69_000]] = np.nan
        light = self.volume.query(positions)
        self.assertEqual(light.not_finite_count, 2)
        self.assertEqual(light.cells[3], tetralight.NO_CELL)

    def test_hints_receive_the_cells(self):
        positions = random_positions(1000)
        hints = np.full(1000, tetralight.NO_CELL, np.uint32)
        first = self.volume.query(positions, hints)
        self.assertIs(first.cells, hints)
        second = self.volume.query(positions, hints)
        self.assertLessEqual(second.step_count, 2 * 1000)
        self.assertLessEqual(second.step_count, first.step_count)

    def test_uses_memory_of_an_answer_again(self):
        a, b = random_positions(500, 1), random_positions(500, 2)
        light = self.volume.query(a)
        again = self.volume.query(b, out=light)
        self.assertIs(again, light)
        self.assert_same_light(light, self.volume.query(b))

    def test_writes_into_an_array(self):
        positions = random_positions(500)
        rows = np.zeros((500, 10, 3), np.float32)
        out = rows[:, 1:]
        light = self.volume.query(positions, out=out)
        self.assertIs(light.sh, out)
        np.testing.assert_array_equal(out, self.volume.query(positions).sh)
        self.assertEqual(rows[:, 0].max(), 0)

    def test_formats_agree(self):
        positions = random_positions(500)
        exact = self.volume.query(positions)
        largest = abs(exact.sh).max()
        packed = self.volume.query(positions, format="packed")
        np.testing.assert_allclose(packed.coefficients, exact.sh, 0, 1e-6 * largest)
        half = self.volume.query(positions, format="half")
        self.assertEqual(half.sh.dtype, np.float16)
        np.testing.assert_allclose(half.sh, exact.sh, 2**-10, 1e-3 * largest)

    def test_threads_of_the_caller_share_a_volume(self):
        positions = random_positions(40_000)
        expected = self.volume.query(positions)
        answers = []
        threads = [
            threading.Thread(target=lambda: answers.append(self.volume.query(positions))) for _ in range(4)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(answers), 4)
        for answer in answers:
            self.assert_same_light(answer, expected)


class Harmonics(unittest.TestCase):
    def test_constant_light_gives_pi(self):
        """Radiance 1 from everywhere: L0 = 1 / Y0 · ∫ Y0² dω = 4π Y0, E0 = π L0, E(n) = E0 Y0 = π."""
        coefficients = np.zeros((9, 3), np.float32)
        coefficients[0] = np.pi * 4 * np.pi * sh.Y0
        normals = np.random.default_rng(3).normal(size=(100, 3))
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        light = sh.irradiance(np.tile(coefficients, (100, 1, 1)), normals)
        np.testing.assert_allclose(light, np.pi, 1e-6)
        np.testing.assert_allclose(sh.mean_irradiance(coefficients), np.pi, 1e-6)

    def test_basis_is_orthonormal(self):
        """A product rule over the sphere that is exact for the products of two basis functions."""
        z, weights = np.polynomial.legendre.leggauss(5)
        angle = np.arange(8) * np.pi / 4
        r = np.sqrt(1 - z * z)
        directions = np.stack(
            [np.outer(r, np.cos(angle)), np.outer(r, np.sin(angle)), np.repeat(z[:, None], 8, 1)], -1
        )
        basis = sh.basis(directions)
        products = np.einsum("a,abi,abj->ij", weights * np.pi / 4, basis, basis)
        np.testing.assert_allclose(products, np.eye(9), 0, 1e-6)
