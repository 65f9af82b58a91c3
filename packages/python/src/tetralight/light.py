# SPDX-License-Identifier: Apache-2.0
"""The light at many positions: what a query answers."""
from __future__ import annotations

from typing import Any

from tetralight import sh as harmonics
from tetralight._arrays import AnyArray, FloatArray

FORMATS: dict[str, tuple[tuple[int, ...], str]] = {
    # Shape and type of the numbers of one position, in the order of tetralight_sh_format.
    "coefficients": ((9, 3), "float32"),
    "packed": ((7, 4), "float32"),
    "half": ((9, 3), "float16"),
}


class Light:
    """Arrays with one element for each position, in the shape of the positions without the last axis."""

    __slots__ = ("sh", "format", "occlusion", "cells", "not_finite_count", "step_count")

    sh: AnyArray
    """Irradiance: "coefficients" and "half" (…, 9, 3), E(n) = sum of E_i Y_i(n); "packed" (…, 7, 4) for
    shaders, which evaluate E(n) / pi."""
    format: str
    occlusion: FloatArray
    """(…, 4): 1 = lit."""
    cells: AnyArray
    """(…): the cells that contain the positions: hints of the next query. NO_CELL if the light is
    ambient."""
    not_finite_count: int
    """Positions that are not finite; they receive the ambient light."""
    step_count: int
    """Cells that the searches tested."""

    def __init__(self, sh: AnyArray, format: str, occlusion: FloatArray, cells: AnyArray) -> None:
        self.sh = sh
        self.format = format
        self.occlusion = occlusion
        self.cells = cells
        self.not_finite_count = 0
        self.step_count = 0

    @property
    def coefficients(self) -> AnyArray:
        """(…, 9, 3): irradiance coefficients, whatever the format."""
        return harmonics.from_packed(self.sh) if self.format == "packed" else self.sh

    def irradiance(self, normals: Any) -> FloatArray:
        """(…, 3): irradiance of surfaces with these unit normals, one for each position or one for all;
        not divided by pi."""
        return harmonics.irradiance(self.coefficients, normals)

    def __len__(self) -> int:
        return int(self.cells.size)

    def __repr__(self) -> str:
        return f"<tetralight.Light: {self.cells.size} positions, {self.format}>"
