# SPDX-License-Identifier: Apache-2.0
"""Checks arrays of callers, and shows memory of the library as arrays."""
from __future__ import annotations

import math
from typing import Any, Sequence

import numpy as np

from tetralight._arguments import LARGEST_FLOAT, finite_numbers, numbers, refused, wrong_shape
from tetralight.errors import BadValue

FloatArray = np.ndarray[Any, np.dtype[np.float32]]
AnyArray = np.ndarray[Any, Any]


class _Memory:
    """Read-only memory of the library. NumPy keeps this object, and with it the owner."""

    def __init__(self, owner: object, pointer: int, shape: Sequence[int], dtype: np.dtype[Any]) -> None:
        self._owner = owner
        self.__array_interface__ = {
            "version": 3,
            "shape": tuple(shape),
            "typestr": dtype.str,
            "data": (pointer, True),
        }


def view_of(
    owner: object,
    pointer: int | None,
    shape: Sequence[int],
    dtype: Any,
    strides: Sequence[int] | None = None,
) -> AnyArray:
    """A read-only array that shows memory without a copy, and keeps `owner` alive."""
    kind = np.dtype(dtype)
    if not pointer or 0 in shape:
        empty: AnyArray = np.zeros(tuple(shape), kind)
        empty.flags.writeable = False
        return empty
    memory = _Memory(owner, pointer, shape, kind)
    if strides is not None:
        memory.__array_interface__["strides"] = tuple(strides)
    return np.asarray(memory)


def shown(shape: Sequence[int | None]) -> str:
    """(…, 3): None is any length, and the first None any number of axes."""
    return "(" + ", ".join("…" if n is None else str(n) for n in shape) + ("," if len(shape) == 1 else "") + ")"


def floats(array: AnyArray, dtype: Any) -> AnyArray:
    """Numbers that are too large for the type become infinite."""
    with np.errstate(over="ignore"):
        return np.asarray(array, dtype)


def vectors(name: str, values: Any, size: int = 3, dtype: Any = np.float32) -> AnyArray:
    """Numbers of the shape (…, size). Copies what has another type or has gaps inside a vector."""
    array = numbers(name, values, f"numbers of the shape {shown((None, size))}")
    if array.ndim == 0 or array.shape[-1] != size:
        raise wrong_shape(name, shown((None, size)), array.shape)
    if array.dtype != dtype:
        array = floats(array, dtype)
    item = array.dtype.itemsize
    if array.strides[-1] != item or not array.flags.aligned:
        array = np.ascontiguousarray(array)
    return array


def check_finite(name: str, rows: AnyArray) -> None:
    """Names the first row that is not finite."""
    is_finite = np.isfinite(rows).all(-1)
    if not is_finite.all():
        index = np.unravel_index(int(np.argmin(is_finite)), is_finite.shape)
        where = f"[{', '.join(map(str, index))}]" if index else ""
        raise refused(f"{name}{where}", "finite numbers", rows[index].tolist())


def three(name: str, values: Any, lowest: float = -LARGEST_FLOAT, highest: float = LARGEST_FLOAT) -> FloatArray:
    """One vector, finite."""
    return finite_numbers(name, values, (3,), lowest, highest).astype(np.float32)


def unit_vector(name: str, values: Any) -> FloatArray:
    """One vector, made as long as 1."""
    array = np.array(numbers(name, values, "a direction"), np.float64)
    largest = float(np.abs(array).max()) if array.shape == (3,) else 0.0
    if not 0.0 < largest < math.inf:
        raise refused(name, "a direction, three numbers", values)
    array /= largest
    unit: FloatArray = (array / np.linalg.norm(array)).astype(np.float32)
    return unit


def each(name: str, values: Any, shape: tuple[int, ...], dtype: Any) -> AnyArray:
    """One number for each position, or one for all of them, without gaps."""
    kind = np.dtype(dtype)
    array = numbers(name, values, str(kind), "fiu" if kind.kind == "f" else "iu")
    if array.shape not in ((), shape):
        raise wrong_shape(name, shape, array.shape)
    if kind.kind == "u" and array.size and (array.min() < 0 or array.max() > np.iinfo(kind).max):
        wrong = array[(array < 0) | (array > np.iinfo(kind).max)] if array.ndim else array
        raise refused(name, f"numbers from 0 to {np.iinfo(kind).max}", wrong.flat[0].item())
    return np.ascontiguousarray(np.broadcast_to(floats(array, kind), shape))


def output(name: str, array: Any, shape: tuple[int, ...], dtype: Any) -> AnyArray:
    """An array of the caller that receives answers. It is never copied."""
    kind = np.dtype(dtype)
    if not isinstance(array, np.ndarray):
        raise BadValue(f"{name}: expected an array of NumPy, given {type(array).__name__}")
    if array.dtype != kind:
        raise BadValue(f"{name}: expected {kind}, given {array.dtype}")
    if array.shape != shape:
        raise wrong_shape(name, shape, array.shape)
    if not array.flags.writeable:
        raise BadValue(f"{name}: expected an array that can be written, given a read-only one")
    return array


def rows(name: str, array: AnyArray, row_axes: int) -> AnyArray:
    """The array with its first axes as one, without a copy: rows whose numbers have no gaps."""
    row_shape = array.shape[array.ndim - row_axes :]
    count = math.prod(array.shape[: array.ndim - row_axes])
    if count == 0:
        return array.reshape((0,) + row_shape)
    flat = array.view()
    try:
        flat.shape = (count,) + row_shape
    except AttributeError:
        raise BadValue(
            f"{name}: expected rows at one distance from each other, given the strides {array.strides}"
        ) from None
    expected = array.dtype.itemsize
    for axis in range(row_axes, 0, -1):
        if flat.strides[axis] != expected and flat.shape[axis] > 1:
            raise BadValue(f"{name}: expected rows without gaps, given the strides {array.strides}")
        expected *= flat.shape[axis]
    if count > 1 and (flat.strides[0] < expected or flat.strides[0] % flat.dtype.itemsize):
        raise BadValue(f"{name}: expected rows that follow each other, given the strides {array.strides}")
    return flat


class Rows:
    """Where the rows of an array are. Keeps the array."""

    def __init__(self, flat: AnyArray) -> None:
        self.array = flat
        self.row = flat.dtype.itemsize * math.prod(flat.shape[1:])
        self.stride = flat.strides[0] if len(flat) > 1 else self.row
        self.pointer: int = flat.__array_interface__["data"][0]

    def part(self, begin: int, end: int) -> tuple[int, int, int]:
        """Address, bytes and stride of some rows: the members of tetralight_array."""
        size = (end - begin - 1) * self.stride + self.row if end > begin else 0
        return self.pointer + begin * self.stride, size, self.stride
