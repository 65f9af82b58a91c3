# SPDX-License-Identifier: Apache-2.0
"""Light probe proxy volumes: a grid of light around a large object, as a 3D texture."""
from __future__ import annotations

import copy
import ctypes
from typing import Any

import numpy as np

from tetralight import _arrays
from tetralight import _declarations as c
from tetralight._arguments import choice, finite_numbers, numbers, refused
from tetralight._arrays import FloatArray
from tetralight._library import call, library

QUALITIES = {"low": c.LPPV_LOW, "normal": c.LPPV_NORMAL, "full": c.LPPV_FULL}
PLACEMENTS = {"cell_corners": c.LPPV_CELL_CORNERS, "cell_centers": c.LPPV_CELL_CENTERS}
LAYOUTS = {"four_slabs": (c.LPPV_FOUR_SLABS, 4), "seven_slabs": (c.LPPV_SEVEN_SLABS, 7)}
FORMATS = {"half": (c.LPPV_HALF, np.float16), "float": (c.LPPV_FLOAT, np.float32)}


class Lppv(np.ndarray[Any, Any]):
    """The texels of a proxy volume, ready to upload: (depth, height, slabs · width, 4)."""

    constants: dict[str, FloatArray]
    """The uniforms of the shader (runtime/shaders/lppv.glsl); matrices are stored by columns."""
    slab_count: int
    """4: SHAr, SHAg, SHAb and occlusion; 7: SHAr, SHAg, SHAb, SHBr, SHBg, SHBb, SHC."""

    def __array_finalize__(self, made_from: Any) -> None:
        self.constants = getattr(made_from, "constants", {})
        self.slab_count = getattr(made_from, "slab_count", 0)

    def __reduce__(self) -> Any:
        function, arguments, state = super().__reduce__()  # type: ignore[misc]
        return function, arguments, (state, self.constants, self.slab_count)

    def __setstate__(self, state: Any) -> None:
        array, self.constants, self.slab_count = state
        super().__setstate__(array)

    def __deepcopy__(self, memo: Any) -> Lppv:
        made: Lppv = super().__deepcopy__(memo)
        made.constants = copy.deepcopy(self.constants, memo)
        return made

    @property
    def slabs(self) -> np.ndarray[Any, Any]:
        """The same memory as (slab, depth, height, width, 4). Call this on the whole texture."""
        depth, height, width, _ = self.shape
        parts = self.view(np.ndarray).reshape(depth, height, self.slab_count, width // self.slab_count, 4)
        return parts.transpose(2, 0, 1, 3, 4)


def box_of(
    low: Any, high: Any, resolution: Any, world_from_box: Any, quality: str, placement: str, layout: str, format: str
) -> c.LppvBox:
    expected = "three integers from 1 to 256"
    counts = numbers("resolution", resolution, expected, "iu")
    if counts.shape != (3,) or counts.min() < 1 or counts.max() > 256:
        raise refused("resolution", expected, resolution)
    matrix = finite_numbers("world_from_box", np.eye(4) if world_from_box is None else world_from_box, (4, 4))
    return c.LppvBox(
        world_from_box=(ctypes.c_float * 16)(*matrix.T.ravel()),
        low=(ctypes.c_float * 3)(*_arrays.three("low", low).tolist()),
        high=(ctypes.c_float * 3)(*_arrays.three("high", high).tolist()),
        resolution=(ctypes.c_uint32 * 3)(*(int(n) for n in counts)),
        placement=choice("placement", placement, PLACEMENTS),
        quality=choice("quality", quality, QUALITIES),
        layout=choice("layout", layout, LAYOUTS)[0],
        format=choice("format", format, FORMATS)[0],
    )


def fill(volume: int, box: c.LppvBox, layout: str, format: str) -> Lppv:
    size = c.LppvSize()
    call(library.tetralight_get_lppv_size, ctypes.byref(box), ctypes.byref(size))
    width, height, depth = size.texels
    texels = np.empty((depth, height, width, 4), choice("format", format, FORMATS)[1])
    array = c.Array(texels.ctypes.data, texels.nbytes, 0)
    constants = c.LppvConstants()
    call(library.tetralight_fill_lppv, volume, ctypes.byref(box), ctypes.byref(array), ctypes.byref(constants))
    made = texels.view(Lppv)
    made.slab_count = choice("layout", layout, LAYOUTS)[1]
    made.constants = {name: np.array(getattr(constants, name), np.float32) for name, _ in c.LppvConstants._fields_}
    return made
