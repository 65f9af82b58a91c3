# SPDX-License-Identifier: Apache-2.0
"""Lightmaps: baked irradiance of static surfaces."""
from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from tetralight import _arrays
from tetralight import _declarations as c
from tetralight._arguments import wrong_shape
from tetralight._arrays import AnyArray, FloatArray
from tetralight._library import Handle, Opened, Source, call, library, opened_file
from tetralight.errors import BadValue, NotThere

NO_PAGE = c.NO_PAGE
MIXED_LIGHTING = ("bounces", "shadow_mask", "direct")

RECTANGLE = np.dtype([("scale", np.float32, 2), ("offset", np.float32, 2), ("page", np.uint32)])


class Lightmaps(Opened):
    """`tetralight.open_lightmaps` makes it. All calls may run in several threads at once."""

    _closed = "the lightmaps are closed"

    def __init__(self, handle: Handle, name: str) -> None:
        super().__init__(handle, name)
        info = c.LightmapsInfo()
        call(library.tetralight_lightmaps_get_info, handle.pointer, ctypes.byref(info))
        self.page_size: int = info.page_size
        """Texels along each side of every page."""
        self.page_count: int = info.page_count
        self.instance_count: int = info.instance_count
        """Instances of the scene, with or without a lightmap."""
        self.has_normals = bool(info.has_light)
        """True if normal maps have an effect."""
        self.has_ambient_occlusion = bool(info.has_ambient_occlusion)
        self.scale = float(info.scale)
        """What halves of textures are multiplied by."""
        self.mixed_lighting = MIXED_LIGHTING[info.mixed_lighting]
        """How mixed lights are in the texels: their bounces; bounces and a shadow mask; bounces and direct
        light."""

    def __repr__(self) -> str:
        return (
            f"<tetralight.Lightmaps {self.name!r}: {self.page_count} pages of {self.page_size}², "
            f"{self.instance_count} instances{', closed' if self._handle is None else ''}>"
        )

    def _texels(self, which: int, channels: tuple[int, ...], dtype: Any) -> AnyArray:
        handle = self._open_handle()
        array = c.ConstArray()
        shape = (self.page_count, self.page_size, self.page_size) + channels
        try:
            call(library.tetralight_lightmaps_get_array, handle.pointer, which, ctypes.byref(array))
        except NotThere:
            return np.zeros((0,) + shape[1:], dtype)
        return _arrays.view_of(handle, array.data, shape, dtype)

    @property
    def irradiance(self) -> AnyArray:
        """(page, row, column, 4): halves, irradiance divided by `scale`, and 1 where a surface is; row 0 is
        at v = 0. A read-only view."""
        return self._texels(c.LIGHTMAP_IRRADIANCE, (4,), np.float16)

    @property
    def validity(self) -> AnyArray:
        """(page, row, column): 255 where rays hit no back face; a read-only view."""
        return self._texels(c.LIGHTMAP_VALIDITY, (), np.uint8)

    @property
    def standard_error(self) -> AnyArray:
        """(page, row, column): halves, the relative standard error of irradiance; a read-only view."""
        return self._texels(c.LIGHTMAP_STANDARD_ERROR, (), np.float16)

    def rectangles(self) -> AnyArray:
        """One a instance, with `scale`, `offset` and `page`: uv_page = uv * scale + offset, with the
        unwrapped uv (TEXCOORD_1) of its mesh. The page is NO_PAGE without a lightmap."""
        handle = self._open_handle()
        made = np.empty(self.instance_count, RECTANGLE)
        place = c.LightmapPlace()
        for instance in range(self.instance_count):
            call(library.tetralight_lightmaps_rectangle, handle.pointer, instance, ctypes.byref(place))
            made[instance] = (tuple(place.scale), tuple(place.offset), place.page)
        return made

    def sample(self, pages: Any, uv_page: Any, base_normals: Any = None, normals: Any = None) -> FloatArray:
        """(…, 3): irradiance at places (…, 2) of pages (one number or one for each place), bilinear, not
        divided by pi. With unit `normals`, as normal maps give them, it is that on these normals, on
        surfaces whose own unit normals are `base_normals`."""
        uv = _arrays.vectors("uv_page", uv_page, 2)
        base = self._directions("base_normals", base_normals, uv.shape[:-1])
        own = self._directions("normals", normals, uv.shape[:-1])
        if (base is None) != (own is None):
            raise BadValue("normals: expected base_normals and normals, given only one of them")
        return self._sampled(library.tetralight_lightmaps_sample, pages, uv, (base, own), 3)

    def shadow_mask(self, pages: Any, uv_page: Any) -> FloatArray:
        """(…, 4): how much of the light of each occlusion channel the places see, 0 to 1."""
        uv = _arrays.vectors("uv_page", uv_page, 2)
        return self._sampled(library.tetralight_lightmaps_shadow_mask, pages, uv, (), 4)

    def ambient_occlusion(self, pages: Any, uv_page: Any) -> FloatArray:
        """(…): how open the surroundings of the places are, 0 to 1."""
        uv = _arrays.vectors("uv_page", uv_page, 2)
        return self._sampled(library.tetralight_lightmaps_ambient_occlusion, pages, uv, (), 1)[..., 0]

    @staticmethod
    def _directions(name: str, values: Any, shape: tuple[int, ...]) -> AnyArray | None:
        if values is None:
            return None
        array = _arrays.vectors(name, values)
        _arrays.check_finite(name, array)
        if array.shape not in ((3,), shape + (3,)):
            raise wrong_shape(name, f"{shape + (3,)} or (3,)", array.shape)
        return np.ascontiguousarray(np.broadcast_to(array, shape + (3,)))

    def _sampled(
        self, function: Any, pages: Any, uv: AnyArray, directions: tuple[AnyArray | None, ...], size: int
    ) -> FloatArray:
        handle = self._open_handle()
        uv = np.ascontiguousarray(uv)
        _arrays.check_finite("uv_page", uv)
        page_of = _arrays.each("pages", pages, uv.shape[:-1], np.uint32).reshape(-1)
        made = np.empty(uv.shape[:-1] + (size,), np.float32)
        inputs = [(array, array.shape[-1] * 4 if array is not None else 0) for array in (uv, *directions)]
        starts = [(array.ctypes.data if array is not None else None, step) for array, step in inputs]
        answer = made.ctypes.data
        for i, page in enumerate(page_of.tolist()):
            places = [None if start is None else start + i * step for start, step in starts]
            call(function, handle.pointer, page, *places, answer + i * size * 4)
        return made


def open_lightmaps(source: Source) -> Lightmaps:
    """Opens a .lightmaps file, or its bytes, and verifies all of it."""
    files = library.tetralight_lightmaps_open, library.tetralight_lightmaps_open_memory
    return Lightmaps(*opened_file(*files, library.tetralight_lightmaps_close, source))
