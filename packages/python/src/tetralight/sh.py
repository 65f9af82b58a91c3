# SPDX-License-Identifier: Apache-2.0
"""Spherical harmonics of irradiance: nine RGB coefficients, E(n) = sum of E_i Y_i(n)."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from tetralight._arguments import finite_numbers, numbers, wrong_shape
from tetralight._arrays import AnyArray, FloatArray, vectors

Y0 = 0.5 / math.sqrt(math.pi)
LARGEST_LIGHT = 1e30
"""Of a sky or a sun. The light of probes stays finite in floats."""
_BLOCK = 16384  # normals whose basis stays in a processor's cache


def basis(directions: AnyArray) -> FloatArray:
    """(…, 9): the real, orthonormal functions 1, y, z, x, xy, yz, 3z² - 1, xz, x² - y² of unit
    directions."""
    x, y, z = (directions[..., axis] for axis in range(3))
    made = np.empty(directions.shape[:-1] + (9,), np.float32)
    made[..., 0] = Y0
    band_1 = math.sqrt(3 / (4 * math.pi))
    for i, value in ((1, y), (2, z), (3, x)):
        made[..., i] = band_1 * value
    band_2 = math.sqrt(15 / (4 * math.pi))
    for i, value in ((4, x * y), (5, y * z), (7, x * z)):
        made[..., i] = band_2 * value
    made[..., 6] = math.sqrt(5 / (16 * math.pi)) * (3 * z * z - 1)
    made[..., 8] = 0.5 * band_2 * (x * x - y * y)
    return made


def irradiance(coefficients: AnyArray, normals: Any) -> FloatArray:
    """(…, 3): irradiance of surfaces with unit normals, not divided by pi. `coefficients` has the shape
    (…, 9, 3); `normals` has one normal for each of them or one for all."""
    if coefficients.ndim < 2 or coefficients.shape[-2:] != (9, 3):
        raise wrong_shape("coefficients", "(…, 9, 3)", coefficients.shape)
    unit = vectors("normals", normals)
    shape = coefficients.shape[:-2]
    if unit.shape[:-1] not in ((), shape):
        raise wrong_shape("normals", f"{shape + (3,)} or (3,)", unit.shape)
    if unit.ndim == 1:
        return np.asarray(np.tensordot(basis(unit), coefficients.astype(np.float32, copy=False), (0, -2)))
    flat = coefficients.reshape(-1, 9, 3)
    flat_normals = unit.reshape(-1, 3)
    made = np.empty((len(flat), 3), np.float32)
    for begin in range(0, len(flat), _BLOCK):
        block = slice(begin, begin + _BLOCK)
        np.einsum("ni,nic->nc", basis(flat_normals[block]), flat[block], out=made[block], casting="same_kind")
    return made.reshape(shape + (3,))


def mean_irradiance(coefficients: AnyArray) -> FloatArray:
    """(…, 3): the mean over all normals."""
    return np.asarray(np.float32(Y0) * coefficients[..., 0, :])


def from_packed(packed: AnyArray) -> FloatArray:
    """(…, 9, 3) from the seven float4 (…, 7, 4) that shaders read: SHAr, SHAg, SHAb, SHBr, SHBg, SHBb,
    SHC (docs/conventions.md)."""
    made = np.empty(packed.shape[:-2] + (9, 3), np.float32)
    third = packed[..., 3:6, 2] / 3
    # Irradiance / pi, whose basis functions are 1, y, z, x, xy, yz, 3z² - 1, xz, x² - y².
    parts = (
        packed[..., 0:3, 3] + third,
        packed[..., 0:3, 1],
        packed[..., 0:3, 2],
        packed[..., 0:3, 0],
        packed[..., 3:6, 0],
        packed[..., 3:6, 1],
        third,
        packed[..., 3:6, 3],
        packed[..., 6, 0:3],
    )
    band_1 = math.sqrt(3 / (4 * math.pi))
    band_2 = math.sqrt(15 / (4 * math.pi))
    scales = (Y0, *(band_1,) * 3, *(band_2,) * 2, math.sqrt(5 / (16 * math.pi)), band_2, 0.5 * band_2)
    for i, (part, scale) in enumerate(zip(parts, scales)):
        made[..., i, :] = part * np.float32(math.pi / scale)
    return made


def sky_coefficients(sky: Any) -> FloatArray:
    """(16, 3): the radiance of a sky in bands 0 to 3, L_i = integral of L Y_i, from one number, RGB, or the
    coefficients themselves."""
    expected = "a number, RGB or the shape (16, 3)"
    array = numbers("sky", sky, expected)
    if array.shape not in ((), (3,), (16, 3)):
        raise wrong_shape("sky", "(), (3,) or (16, 3)", array.shape)
    array = finite_numbers("sky", array, array.shape, -LARGEST_LIGHT, LARGEST_LIGHT)
    made = np.zeros((16, 3), np.float32)
    if array.ndim == 2:
        made[...] = array
    else:
        made[0] = array * (4 * math.pi * Y0)  # the integral of a constant times Y_0
    return made
