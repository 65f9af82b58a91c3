# SPDX-License-Identifier: Apache-2.0
"""The arrays of a volume. They never change after a caller has them.

Those of the file are views, which are valid as long as the handle. The library can replace light that a
call has changed, so that changed light is copied."""
from __future__ import annotations

import ctypes
import functools
import math
from typing import Any, Sequence

import numpy as np

from tetralight import _declarations as c
from tetralight._arrays import AnyArray, view_of
from tetralight._library import Handle, call, library
from tetralight.errors import Corrupt, NotThere


class Contents:
    def __init__(self, handle: Handle, probe_count: int, world_origin: tuple[float, ...]) -> None:
        self.handle = handle
        self._probe_count = probe_count
        self._world_origin = world_origin
        self._is_changed = False
        self._irradiance: AnyArray | None = None

    def _view(self, which: int, row: Sequence[int], dtype: Any) -> AnyArray | None:
        """None if the volume does not hold the array."""
        array = c.ConstArray()
        try:
            call(library.tetralight_get_array, self.handle.pointer, which, ctypes.byref(array))
        except NotThere:
            return None
        row_bytes = math.prod(row) * np.dtype(dtype).itemsize
        count = (array.size - row_bytes) // array.stride + 1
        item = np.dtype(dtype).itemsize
        inner = [item * math.prod(row[axis + 1 :]) for axis in range(len(row))]
        return view_of(self.handle, array.data, (count, *row), dtype, (array.stride, *inner))

    def _text(self, which: int) -> str:
        view = self._view(which, (), np.uint8)
        return "" if view is None else view.tobytes().decode("utf-8", "replace")

    @functools.cached_property
    def positions(self) -> AnyArray:
        exact = self._view(c.ARRAY_EXACT_POSITIONS, (3,), np.float64)
        if exact is not None:
            return exact
        local = self._view(c.ARRAY_POSITIONS, (3,), np.float32)
        made = np.zeros((0, 3)) if local is None else local + np.array(self._world_origin)
        return read_only(made)

    @functools.cached_property
    def cells(self) -> AnyArray:
        return self._or_empty(self._view(c.ARRAY_CELL_VERTICES, (4,), np.uint32), (4,), np.uint32)

    @functools.cached_property
    def neighbors(self) -> AnyArray:
        return self._or_empty(self._view(c.ARRAY_CELL_NEIGHBORS, (4,), np.uint32), (4,), np.uint32)

    @functools.cached_property
    def validity(self) -> AnyArray:
        view = self._view(c.ARRAY_VALIDITY, (), np.float32)
        if view is not None:
            return view
        halves = self._view(c.ARRAY_HALVES, (32,), np.float16)
        if halves is None:
            return read_only(np.ones(self._probe_count, np.float32))
        return read_only(halves[:, 31].astype(np.float32))

    @functools.cached_property
    def standard_error(self) -> AnyArray:
        view = self._view(c.ARRAY_STANDARD_ERROR, (), np.float32)
        return read_only(np.zeros(self._probe_count, np.float32)) if view is None else view

    def metadata(self) -> dict[str, Any]:
        import json

        try:
            made = json.loads(self._text(c.ARRAY_METADATA) or "{}")
        except (ValueError, RecursionError) as reason:
            raise Corrupt(f"metadata: not JSON: {reason}") from reason
        if not isinstance(made, dict):
            raise Corrupt("metadata: not a JSON object")
        return made

    def ambient(self) -> AnyArray:
        return np.array(self._details().ambient, np.float32).reshape(9, 3)

    def _details(self) -> c.Details:
        details = c.Details()
        call(library.tetralight_get_details, self.handle.pointer, ctypes.byref(details))
        return details

    def layers(self, count: int) -> dict[str, float]:
        found = {}
        for index in range(count):
            layer = c.Layer()
            call(library.tetralight_get_layer, self.handle.pointer, index, ctypes.byref(layer))
            found[layer.name.decode("utf-8", "replace")] = float(layer.weight)
        return found

    def irradiance(self) -> AnyArray:
        """(probe, 9, 3)"""
        if self._irradiance is None:
            view = self._view(c.ARRAY_IRRADIANCE, (9, 3), np.float32)
            if view is None:
                view = self._irradiance_from_halves()
            elif self._is_changed:
                view = read_only(view.copy())
            self._irradiance = view
        return self._irradiance

    def _irradiance_from_halves(self) -> AnyArray:
        halves = self._view(c.ARRAY_HALVES, (32,), np.float16)
        if halves is None:
            return read_only(np.zeros((0, 9, 3), np.float32))
        light = halves[:, :27].astype(np.float32) * np.float32(self._details().half_scale)
        return read_only(light.reshape(-1, 9, 3))

    def prepare_change(self) -> None:
        """Before a call that changes the light: what does not change is shown from the file."""
        for name in ("positions", "cells", "neighbors", "validity", "standard_error"):
            getattr(self, name)
        self._is_changed = True
        self._irradiance = None

    @staticmethod
    def _or_empty(view: AnyArray | None, row: tuple[int, ...], dtype: Any) -> AnyArray:
        return read_only(np.zeros((0, *row), dtype)) if view is None else view


def read_only(array: AnyArray) -> AnyArray:
    array.flags.writeable = False
    return array
