# SPDX-License-Identifier: Apache-2.0
"""Reflection probes: cubes of radiance, blurred for each roughness."""
from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from tetralight import _arrays
from tetralight import _declarations as c
from tetralight._arguments import integer, refused, wrong_shape
from tetralight._arrays import AnyArray, FloatArray
from tetralight._library import Handle, Opened, Source, call, library, opened_file

PROBE = np.dtype(
    [
        ("position", np.float64, 3),
        ("box_center", np.float32, 3),
        ("half_size", np.float32, 3),
        ("axes", np.float32, (3, 3)),
        ("blend_distance", np.float32),
        ("importance", np.int32),
        ("validity", np.float32),
    ]
)


class Reflections(Opened):
    """`tetralight.open_reflections` makes it. All calls may run in several threads at once."""

    _closed = "the reflection probes are closed"

    def __init__(self, handle: Handle, name: str) -> None:
        super().__init__(handle, name)
        info = c.ReflectionsInfo()
        call(library.tetralight_reflections_get_info, handle.pointer, ctypes.byref(info))
        self.size: int = info.size
        """Texels along each side of a face of level 0; half as many in each further level."""
        self.level_count: int = info.level_count
        """Level i is blurred for the roughness 1 - sqrt(1 - i / (level_count - 1))."""
        self.probe_count: int = info.probe_count

    def __repr__(self) -> str:
        return (
            f"<tetralight.Reflections {self.name!r}: {self.probe_count} cubes of {self.size}², "
            f"{self.level_count} levels{', closed' if self._handle is None else ''}>"
        )

    def probes(self) -> AnyArray:
        """Where each cube was captured and where it is used: `position`, `box_center` (relative to it),
        `half_size`, `axes`, `blend_distance`, `importance`, `validity`."""
        handle = self._open_handle()
        made = np.empty(self.probe_count, PROBE)
        probe = c.ReflectionProbe()
        for index in range(self.probe_count):
            call(library.tetralight_reflections_get_probe, handle.pointer, index, ctypes.byref(probe))
            for name in PROBE.names or ():
                made[name][index] = np.reshape(getattr(probe, name), PROBE[name].shape)
        return made

    def texels(self, level: int = 0) -> AnyArray:
        """(probe, face, row, column, 4): halves of a level, without a copy. Faces: +X, -X, +Y, -Y, +Z, -Z."""
        handle = self._open_handle()
        array = c.ConstArray()
        level = integer("level", level)
        call(library.tetralight_reflections_texels, handle.pointer, level, ctypes.byref(array))
        side = max(1, self.size >> level)
        return _arrays.view_of(handle, array.data, (self.probe_count, 6, side, side, 4), np.float16)

    def sample(self, positions: Any, directions: Any, roughness: Any = 0.0) -> FloatArray:
        """(…, 3): radiance that surfaces at positions (…, 3) see in directions (…, 3), the view mirrored at
        their normals; roughness is one number or one for each position."""
        handle = self._open_handle()
        points = np.ascontiguousarray(_arrays.vectors("positions", positions, 3, np.float64))
        rays = np.ascontiguousarray(_arrays.vectors("directions", directions))
        if rays.shape != points.shape:
            raise wrong_shape("directions", points.shape, rays.shape)
        _arrays.check_finite("positions", points)
        _arrays.check_finite("directions", rays)
        rough = _arrays.each("roughness", roughness, points.shape[:-1], np.float32).reshape(-1)
        is_wrong = ~((rough >= 0) & (rough <= 1))
        if is_wrong.any():
            raise refused("roughness", "numbers from 0 to 1", float(rough[is_wrong][0]))
        made = np.empty(points.shape, np.float32)
        blend = c.ReflectionBlend()
        for i, value in enumerate(rough.tolist()):
            point = points.ctypes.data + i * 24
            call(library.tetralight_reflections_blend, handle.pointer, point, ctypes.byref(blend))
            ray, answer = rays.ctypes.data + i * 12, made.ctypes.data + i * 12
            function = library.tetralight_reflections_sample
            call(function, handle.pointer, ctypes.byref(blend), point, ray, value, answer)
        return made


def open_reflections(source: Source) -> Reflections:
    """Opens the reflection probes that `tetralight reflect` writes (.ktx2), or their bytes, and verifies all
    of them."""
    files = library.tetralight_reflections_open, library.tetralight_reflections_open_memory
    return Reflections(*opened_file(*files, library.tetralight_reflections_close, source))
