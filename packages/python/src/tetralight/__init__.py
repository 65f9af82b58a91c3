# SPDX-License-Identifier: Apache-2.0
"""Baked light probes: open, query, relight and show .probes files with NumPy.

    volume = tetralight.open("courtyard.probes")
    light = volume.query(positions)              # positions: (N, 3)
    light.irradiance(normals)                    # (N, 3), in the lights' own unit, not divided by pi

Space is right-handed, Y up, in metres; light is linear Rec.709.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tetralight._declarations import NO_CELL
from tetralight._library import version as _version
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
from tetralight.light import Light
from tetralight.lightmaps import NO_PAGE, Lightmaps, open_lightmaps
from tetralight.lppv import Lppv
from tetralight.picture import tone_mapped, write_png
from tetralight.reflections import Reflections, open_reflections
from tetralight.scene_light import SceneLight
from tetralight.volume import Volume, open

__version__ = _version()

__all__ = [
    "NO_CELL",
    "NO_PAGE",
    "BadValue",
    "Cancelled",
    "Client",
    "Closed",
    "Corrupt",
    "Error",
    "Grid",
    "Light",
    "Lightmaps",
    "Lppv",
    "NotFound",
    "NotThere",
    "OutOfMemory",
    "Reflections",
    "SceneLight",
    "Unavailable",
    "Unsupported",
    "Volume",
    "bake",
    "check_leaks",
    "grid",
    "open",
    "open_lightmaps",
    "open_reflections",
    "run",
    "tone_mapped",
    "verify",
    "write_png",
]

# Imported at their first use: programs that only query do not load them.
if TYPE_CHECKING:
    from tetralight.client import Client
    from tetralight.commands import Grid, bake, check_leaks, grid, run, verify

_LATER = {
    "Client": "client",
    "Grid": "commands",
    "bake": "commands",
    "check_leaks": "commands",
    "grid": "commands",
    "run": "commands",
    "verify": "commands",
}


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    import importlib

    value = getattr(importlib.import_module(f"{__name__}.{_LATER[name]}"), name)
    globals()[name] = value
    return value
