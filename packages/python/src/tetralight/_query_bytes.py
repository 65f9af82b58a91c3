# SPDX-License-Identifier: Apache-2.0
"""The binary form of queries of the service (docs/server.md, "Queries")."""
from __future__ import annotations

import struct
from typing import Any

import numpy

from tetralight._arguments import choice, number, refused
from tetralight._settings import bad_value
from tetralight.errors import Error

POSITIVE = "a finite number > 0"
HEADER = struct.Struct("<4sIBBBBf")
OCCLUSION, CELLS, IGNORE_WALLS = 1, 2, 4
# The copies of the light that the library reads, too.
HALF_PRECISION = 1
OUTSIDE = {"extrapolate": 0, "clamp": 1, "ambient": 2}
WALLS = {"hide": 0, "ignore": IGNORE_WALLS}
# Number of the form, shape and type of the light of one position.
FORMATS: dict[str, tuple[int, tuple[int, ...], str]] = {
    "coefficients": (1, (9, 3), "<f4"),
    "packed": (2, (7, 4), "<f4"),
    "half": (3, (9, 3), "<f2"),
}
LOCATION = numpy.dtype([("cell", "<u4"), ("ambient", "<f4"), ("weights", "<f4", 4)])


def write_request(
    rows: numpy.ndarray[Any, Any], first: int, format: str, outside: str, fade: float | None, walls: str
) -> bytes:
    """`rows` (N, 3) are the positions from number `first` on."""
    with numpy.errstate(over="ignore"):
        floats = numpy.ascontiguousarray(rows, dtype="<f4")
    is_finite = numpy.isfinite(floats).all(axis=1)
    if not is_finite.all():
        row = int(numpy.argmin(is_finite))
        raise bad_value(f"positions[{first + row}]", rows[row].tolist(), "is too large for floats")
    form, _, _ = choice("format", format, FORMATS)
    wants = OCCLUSION | CELLS | choice("walls", walls, WALLS)
    if fade is not None and number("fade_distance", fade, 0, expected=POSITIVE) == 0:
        raise refused("fade_distance", POSITIVE, fade)
    header = HEADER.pack(b"TLQ1", len(rows), form, wants, choice("outside", outside, OUTSIDE), HALF_PRECISION,
                         fade or 0.0)
    return header + floats.tobytes()


def read_answer(data: bytes, format: str) -> tuple[Any, Any, Any]:
    """Light, occlusion (N, 4) and cells (N,) of an answer."""
    number, shape, kind = FORMATS[format]
    dtype = numpy.dtype((kind, shape))
    magic, count, sh, wants = HEADER.unpack_from(data)[:4] if len(data) >= HEADER.size else (b"", 0, 0, 0)
    occlusion_begin = -(-(HEADER.size + count * dtype.itemsize) // 4) * 4
    cells_begin = occlusion_begin + 16 * count
    is_right = magic == b"TLA1" and sh == number and wants & 3 == OCCLUSION | CELLS
    if not is_right or len(data) != cells_begin + LOCATION.itemsize * count:
        raise Error("the service does not answer queries as Tetralight does", "bad_answer")
    flat = numpy.frombuffer(data, kind, count * int(numpy.prod(shape)), HEADER.size)
    occlusion = numpy.frombuffer(data, "<f4", 4 * count, occlusion_begin).reshape(count, 4)
    cells = numpy.frombuffer(data, LOCATION, count, cells_begin)["cell"]
    return flat.reshape((count, *shape)), occlusion, cells
