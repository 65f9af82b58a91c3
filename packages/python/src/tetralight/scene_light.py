# SPDX-License-Identifier: Apache-2.0
"""A light of the scene, in the units of glTF; world space."""
from __future__ import annotations

import ctypes
from typing import NamedTuple, Optional, Tuple

from tetralight import _declarations as c
from tetralight._library import call, library

Vector = Tuple[float, float, float]

TYPES = ("directional", "point", "spot", "rectangle", "disc")
MODES = ("mixed", "baked", "realtime")
FALLOFFS = ("gltf", "inverse_square_range", "linear", "legacy")


class SceneLight(NamedTuple):
    name: str
    type: str
    """One of "directional", "point", "spot", "rectangle", "disc"."""
    mode: str
    """What the probes hold: its bounces ("mixed"), all of it ("baked"), or nothing ("realtime")."""
    falloff: str
    channel: Optional[int]
    """Its channel of the probes' occlusion."""
    weight: float
    """The weight of its layer; 1 = as baked."""
    intensity: Vector
    """Linear RGB: lux for directional lights, candela for the others."""
    position: Vector
    direction: Vector
    """The unit vector along which it shines."""
    range: float
    """Metres; 0 = without end."""
    cos_inner_cone: float
    cos_outer_cone: float
    radius: float
    """Metres; of directional lights half the angle in the sky, radians."""
    tangent: Vector
    """Of rectangles: the unit vector along the width."""
    width: float
    height: float


def scene_light(volume: int, index: int) -> SceneLight:
    light = c.SceneLight()
    call(library.tetralight_get_scene_light, volume, index, ctypes.byref(light))
    values = {name: getattr(light, name) for name, _ in c.SceneLight._fields_}
    for name in ("intensity", "position", "direction", "tangent"):
        values[name] = tuple(values[name])
    values["name"] = light.name.decode("utf-8", "replace")
    values["channel"] = None if light.channel == c.NO_CELL else light.channel
    for name, names in (("type", TYPES), ("mode", MODES), ("falloff", FALLOFFS)):
        values[name] = names[values[name]]
    return SceneLight(**values)
