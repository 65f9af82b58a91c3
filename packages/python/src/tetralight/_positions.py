# SPDX-License-Identifier: Apache-2.0
"""Probe positions as arrays, and as files of probe groups."""
from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Mapping

import numpy
import numpy.typing

from tetralight._arguments import numbers
from tetralight._settings import bad_value
from tetralight.errors import Unavailable

Positions = numpy.typing.ArrayLike

# The command reads files of probe groups below 4 GiB; `[0,0,0],` has 8 bytes.
MOST_BYTES = 2**32 - 1
MOST_POSITIONS = MOST_BYTES // 8
ROWS_AT_ONCE = 65536


def checked_positions(name: str, positions: Positions) -> numpy.ndarray[Any, Any]:
    """An array of shape (N, 3) of finite numbers, without a copy where it is one already."""
    array = numbers(name, positions, "real numbers of the shape (N, 3)")
    if array.ndim != 2 or array.shape[1] != 3:
        raise bad_value(name, array.shape, "is not a shape (N, 3)")
    if len(array) > MOST_POSITIONS:
        raise bad_value(name, len(array), f"are too many positions: at most {MOST_POSITIONS}")
    for begin in range(0, len(array), ROWS_AT_ONCE):
        is_finite = numpy.isfinite(array[begin : begin + ROWS_AT_ONCE]).all(axis=1)
        if not is_finite.all():
            row = begin + int(numpy.argmin(is_finite))
            raise bad_value(f"{name}[{row}]", array[row].tolist(), "is not finite")
    return array


def write_groups(path: Path, groups: Mapping[str, Positions]) -> None:
    """Writes a file of probe groups (.json). Numbers keep their bits."""
    arrays = {str(name): checked_positions(f"groups[{name!r}]", positions) for name, positions in groups.items()}
    try:
        with path.open("w", encoding="utf-8") as file:
            _write(file, arrays)
    except OSError as reason:
        raise Unavailable(f"{path} cannot be written: {reason.strerror or reason}") from reason


def _write(file: Any, arrays: Mapping[str, numpy.ndarray[Any, Any]]) -> None:
    file.write('{"groups": [')
    for index, (name, array) in enumerate(arrays.items()):
        file.write(f'{", " if index else ""}{{"name": {json.dumps(name)}, "positions": [')
        for begin in range(0, len(array), ROWS_AT_ONCE):
            rows = array[begin : begin + ROWS_AT_ONCE].astype(numpy.float64).tolist()
            file.write(("," if begin else "") + json.dumps(rows, separators=(",", ":"))[1:-1])
            if file.tell() > MOST_BYTES:
                raise bad_value("positions", sum(map(len, arrays.values())), "are too many: their file has over 4 GiB")
        file.write("]}")
    file.write("]}")


def read_groups(path: Path) -> dict[str, numpy.ndarray[Any, Any]]:
    """The world positions of each group of a file that the command wrote."""
    groups = {}
    for group in json.loads(path.read_bytes())["groups"]:
        local = numpy.array(group["positions"], dtype=numpy.float64).reshape(-1, 3)
        transform = numpy.array(group.get("transform", numpy.eye(4)), dtype=numpy.float64).reshape(4, 4)
        is_moved = not numpy.array_equal(transform, numpy.eye(4))
        # Rows of the column-major matrix are its columns.
        groups[group["name"]] = local @ transform[:3, :3] + transform[3, :3] if is_moved else local
    return groups
