# SPDX-License-Identifier: Apache-2.0
"""A probe volume: baked probes joined by tetrahedra that together fill space."""
from __future__ import annotations

import ctypes
import os
from typing import Any

import numpy as np

from tetralight import _arrays
from tetralight import _declarations as c
from tetralight import _query
from tetralight._arrays import AnyArray, FloatArray
from tetralight._gate import Gate
from tetralight._library import Handle, call, library, opened
from tetralight.errors import BadValue, Closed, NotThere
from tetralight.light import Light

DIMENSIONS = ("no probes", "one probe", "a line", "a plane", "space")


class Volume:
    """`tetralight.open` makes it. All calls may run in several threads at once: those that change the
    light (`recombine`, `relight`) wait for the others."""

    def __init__(self, handle: Handle, name: str) -> None:
        self._handle: Handle | None = handle
        self._gate = Gate()
        self.name = name
        info = c.Info()
        call(library.tetralight_get_info, handle.pointer, ctypes.byref(info))
        self.probe_count: int = info.probe_count
        self.cell_count: int = info.cell_count
        self.inner_cell_count: int = info.inner_cell_count
        """Cells with this index or a higher one lie outside the hull of the probes."""
        self.dimension: int = info.dimension
        """0 no probes, 1 one probe, 2 probes on a line, 3 in a plane, 4 in space."""
        self.has_light = bool(info.has_light)
        self.has_occlusion = bool(info.has_occlusion)
        self._layer_count: int = info.layer_count

    # Opening and closing

    def close(self) -> None:
        """Calls fail with `Closed` from now on. Arrays that show the volume stay valid: the memory is
        freed with the last of them."""
        self._handle = None

    @property
    def is_closed(self) -> bool:
        return self._handle is None

    def __enter__(self) -> Volume:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _open_handle(self) -> Handle:
        handle = self._handle
        if handle is None:
            raise Closed(f"{self.name}: the volume is closed")
        return handle

    def __len__(self) -> int:
        return self.probe_count

    def __bool__(self) -> bool:
        return True

    def __repr__(self) -> str:
        if self.is_closed:
            return f"<tetralight.Volume {self.name!r}, closed>"
        return (
            f"<tetralight.Volume {self.name!r}: {self.probe_count} probes in {DIMENSIONS[self.dimension]}, "
            f"{self.inner_cell_count} cells{'' if self.has_light else ', not baked'}>"
        )

    # Queries

    def query(
        self,
        positions: Any,
        hints: AnyArray | None = None,
        out: Light | AnyArray | None = None,
        *,
        format: str = "coefficients",
        outside: str = "extrapolate",
        fade_distance: float = 1.0,
        walls: str = "hide",
        rendering_layers: Any = None,
        radii: Any = None,
        normals: Any = None,
        normal_offset: float = c.NORMAL_OFFSET,
        threads: int | None = None,
    ) -> Light:
        """The light at positions (…, 3), on all cores, without the interpreter lock.

        hints: uint32 (…), the cells where searches start; receives the cells found.
        out: an answer of the same shape, or an array for its `sh`, whose memory is used again.
        format: "coefficients", "packed" (for shaders) or "half".
        outside: the light outside the hull of the probes: "extrapolate", "clamp", or "ambient", which
            fades to the ambient light over `fade_distance` metres.
        walls: "hide" probes that walls of the scene hide, or "ignore" walls.
        rendering_layers: uint32, bit i: what is lit is on layer i; one number or one for each position.
        radii: metres over which light of probes behind a wall fades; one number or one for each position.
        normals: unit normals of surfaces on which the positions lie; they are pushed off along them by the
            share `normal_offset` of the mean distance to the probes.
        threads: at most this many; by default all processors.
        """
        points = _arrays.vectors("positions", positions)
        options = _query.Options(
            format, outside, fade_distance, walls, rendering_layers, radii, normals, normal_offset, threads
        )
        light = _query.outputs(points.shape[:-1], hints, out, format)
        handle = self._open_handle()
        self._gate.enter()
        try:
            return _query.answer(handle.pointer, points, light, options)
        finally:
            self._gate.leave()

    # Layers

    @property
    def layers(self) -> dict[str, float]:
        """The layers of light, such as "sky" or "light:lamp", and their weights; 1 = as baked."""
        handle = self._open_handle()
        self._gate.enter()
        try:
            found = {}
            for index in range(self._layer_count):
                layer = c.Layer()
                call(library.tetralight_get_layer, handle.pointer, index, ctypes.byref(layer))
                found[layer.name.decode("utf-8", "replace")] = float(layer.weight)
            return found
        finally:
            self._gate.leave()

    def recombine(self, weights: Any = None, /, **by_name: float) -> None:
        """Replaces the light by the sum of the layers times weights >= 0: an array with one weight for
        each layer, or a dictionary or keywords by name, in which a layer that is not named keeps its
        weight. Arrays from before keep the light that they show."""
        current = self.layers
        if weights is None or hasattr(weights, "keys"):
            chosen = {**dict(weights or {}), **by_name}
            unknown = sorted(set(chosen) - set(current))
            if unknown:
                raise NotThere(f"{self.name}: there is no layer {unknown[0]!r}; layers: {', '.join(current) or 'none'}")
            weights = list({**current, **chosen}.values())
        elif by_name:
            raise BadValue("weights: expected an array or names, given both")
        array = np.ascontiguousarray(weights, np.float32)
        if array.shape != (self._layer_count,):
            raise BadValue(f"weights: expected the shape ({self._layer_count},), given {array.shape}")
        handle = self._open_handle()
        self._gate.close()
        try:
            call(library.tetralight_recombine, handle.pointer, array.ctypes.data, len(array))
        finally:
            self._gate.open()


def open(source: str | os.PathLike[str] | bytes | bytearray | memoryview) -> Volume:
    """Opens a .probes file, or its bytes, and verifies all of it."""
    if isinstance(source, (bytes, bytearray, memoryview)):
        raise NotImplementedError
    path = os.fspath(source)
    handle = opened_path(path)
    return Volume(handle, path)


def opened_path(path: str) -> Handle:
    return opened(library.tetralight_open, library.tetralight_close, os.fsencode(path))
