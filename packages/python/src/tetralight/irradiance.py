# SPDX-License-Identifier: Apache-2.0
"""The light of a volume's probes, and the light between them."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from tetralight._arrays import FloatArray

if TYPE_CHECKING:
    from tetralight.volume import Volume


class ProbeIrradiance(np.ndarray[Any, Any]):
    """Irradiance coefficients of the probes, (probe, 9, 3). Called with positions and normals, it gives
    the irradiance between the probes."""

    _volume: Volume | None

    def __array_finalize__(self, made_from: Any) -> None:
        self._volume = None

    def __call__(self, positions: Any, normals: Any, **options: Any) -> FloatArray:
        """(…, 3): irradiance of surfaces at positions (…, 3) with unit normals, one for each position or
        one for all; not divided by pi. `options` are those of `Volume.query`."""
        if self._volume is None:
            raise TypeError("only the array that Volume.irradiance gives can be called")
        return self._volume.query(positions, **options).irradiance(normals)


def of_probes(array: Any, volume: Volume) -> ProbeIrradiance:
    made: ProbeIrradiance = array.view(ProbeIrradiance)
    made._volume = volume
    return made
