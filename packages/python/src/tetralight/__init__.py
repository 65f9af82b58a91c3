# SPDX-License-Identifier: Apache-2.0
"""Baked light probes: open, query, relight and show .probes files with NumPy.

    volume = tetralight.open("courtyard.probes")
    light = volume.query(positions)              # positions: (N, 3)
    light.irradiance(normals)                    # (N, 3), in the lights' own unit, not divided by pi

Space is right-handed, Y up, in metres; light is linear Rec.709.
"""
from __future__ import annotations

from tetralight.errors import (
    BadValue,
    Cancelled,
    Closed,
    Corrupt,
    Error,
    NotFound,
    NotThere,
    OutOfMemory,
    Unavailable,
    Unsupported,
)

__all__ = [
    "BadValue",
    "Cancelled",
    "Closed",
    "Corrupt",
    "Error",
    "NotFound",
    "NotThere",
    "OutOfMemory",
    "Unavailable",
    "Unsupported",
]
