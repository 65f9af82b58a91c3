# SPDX-License-Identifier: Apache-2.0
"""The C API for ctypes. Written by packages/bindings/generate.py from runtime/tetralight.h: change that header."""
from __future__ import annotations

import ctypes
from ctypes import (
    POINTER,
    Structure,
    c_char,
    c_char_p,
    c_double,
    c_float,
    c_int,
    c_int32,
    c_size_t,
    c_uint32,
    c_uint64,
    c_void_p,
)
from typing import Any

VERSION = "0.1.0"
NO_CELL = 0xffffffff
NORMAL_OFFSET = 0.1
SHADER_ARRAY_COUNT = 7
NO_PAGE = 0xffffffff
OK = 0
BAD_POINTER = 1
BAD_VALUE = 2
SHORT_BUFFER = 3
BAD_FILE = 4
NOT_THERE = 5
OUT_OF_MEMORY = 6
CORRUPT = 7
UNSUPPORTED = 8
UNAVAILABLE = 9
OUT_OF_RESOURCES = 10
DISK_FULL = 11
CANCELLED = 12
EXTRAPOLATE = 0
CLAMP = 1
AMBIENT = 2
HIDE_PROBES = 0
IGNORE_WALLS = 1
SH_COEFFICIENTS = 0
SH_PACKED = 1
SH_HALF = 2
ARRAY_POSITIONS = 0
ARRAY_EXACT_POSITIONS = 1
ARRAY_IRRADIANCE = 2
ARRAY_HALVES = 3
ARRAY_OCCLUSION = 4
ARRAY_VALIDITY = 5
ARRAY_STANDARD_ERROR = 6
ARRAY_SURFACE_DISTANCE = 7
ARRAY_VIRTUAL_OFFSET = 8
ARRAY_DILATED = 9
ARRAY_RENDERING_LAYERS = 10
ARRAY_CELL_VERTICES = 11
ARRAY_CELL_NEIGHBORS = 12
ARRAY_HULL_RAYS = 13
ARRAY_SOURCES = 14
ARRAY_LAYER_IRRADIANCE = 15
ARRAY_LAYER_ERRORS = 16
ARRAY_SKY = 17
ARRAY_GROUP_NAMES = 18
ARRAY_LIGHT_NAMES = 19
ARRAY_LAYER_NAMES = 20
ARRAY_METADATA = 21
LIGHT_DIRECTIONAL = 0
LIGHT_POINT = 1
LIGHT_SPOT = 2
LIGHT_RECTANGLE = 3
LIGHT_DISC = 4
LIGHT_MIXED = 0
LIGHT_BAKED = 1
LIGHT_REALTIME = 2
FALLOFF_GLTF = 0
FALLOFF_INVERSE_SQUARE_RANGE = 1
FALLOFF_LINEAR = 2
FALLOFF_LEGACY = 3
LPPV_LOW = 0
LPPV_NORMAL = 1
LPPV_FULL = 2
LPPV_CELL_CORNERS = 0
LPPV_CELL_CENTERS = 1
LPPV_FOUR_SLABS = 0
LPPV_SEVEN_SLABS = 1
LPPV_HALF = 0
LPPV_FLOAT = 1
LIGHTMAP_IRRADIANCE = 0
LIGHTMAP_LIGHT = 1
LIGHTMAP_VALIDITY = 2
LIGHTMAP_STANDARD_ERROR = 3
LIGHTMAP_SHADOW_MASK = 4
LIGHTMAP_AMBIENT_OCCLUSION = 5
LIGHTMAP_INSTANCE_NAMES = 6
LIGHTMAP_METADATA = 7


class Error(Structure):
    _fields_ = [
        ("message", c_char * 512),
    ]


class Info(Structure):
    _fields_ = [
        ("probe_count", c_uint32),
        ("cell_count", c_uint32),
        ("inner_cell_count", c_uint32),
        ("dimension", c_uint32),
        ("has_light", c_uint32),
        ("has_occlusion", c_uint32),
        ("layer_count", c_uint32),
    ]


class Layer(Structure):
    _fields_ = [
        ("name", c_char * 128),
        ("weight", c_float),
    ]


class Light(Structure):
    _fields_ = [
        ("packed", c_float * 28),
        ("occlusion", c_float * 4),
        ("weights", c_float * 4),
        ("cell", c_uint32),
    ]


class Array(Structure):
    _fields_ = [
        ("data", c_void_p),
        ("size", c_size_t),
        ("stride", c_size_t),
    ]


class ConstArray(Structure):
    _fields_ = [
        ("data", c_void_p),
        ("size", c_size_t),
        ("stride", c_size_t),
    ]


class Batch(Structure):
    _fields_ = [
        ("count", c_size_t),
        ("positions", ConstArray),
        ("hints", Array),
        ("sh", Array),
        ("sh_format", c_uint32),
        ("occlusion", Array),
        ("outside", c_uint32),
        ("fade_distance", c_float),
        ("walls", c_uint32),
        ("rendering_layers", ConstArray),
        ("radii", ConstArray),
        ("normals", ConstArray),
        ("normal_offset", c_float),
    ]


class Report(Structure):
    _fields_ = [
        ("not_finite_count", c_uint64),
        ("step_count", c_uint64),
    ]


class Instances(Structure):
    _fields_ = [
        ("count", c_size_t),
        ("positions", ConstArray),
        ("hints", Array),
        ("sh", Array * 7),
        ("occlusion", Array),
        ("walls", c_uint32),
        ("rendering_layers", ConstArray),
        ("radii", ConstArray),
    ]


class Details(Structure):
    _fields_ = [
        ("world_origin", c_double * 3),
        ("low", c_double * 3),
        ("high", c_double * 3),
        ("ambient", c_float * 27),
        ("half_scale", c_float),
        ("knows_walls", c_uint32),
        ("can_relight_sky", c_uint32),
        ("can_relight_sun", c_uint32),
        ("light_count", c_uint32),
    ]


class SceneLight(Structure):
    _fields_ = [
        ("name", c_char * 128),
        ("type", c_uint32),
        ("mode", c_uint32),
        ("falloff", c_uint32),
        ("channel", c_uint32),
        ("weight", c_float),
        ("intensity", c_float * 3),
        ("position", c_float * 3),
        ("direction", c_float * 3),
        ("range", c_float),
        ("cos_inner_cone", c_float),
        ("cos_outer_cone", c_float),
        ("radius", c_float),
        ("tangent", c_float * 3),
        ("width", c_float),
        ("height", c_float),
    ]


class LppvBox(Structure):
    _fields_ = [
        ("world_from_box", c_float * 16),
        ("low", c_float * 3),
        ("high", c_float * 3),
        ("resolution", c_uint32 * 3),
        ("placement", c_uint32),
        ("quality", c_uint32),
        ("layout", c_uint32),
        ("format", c_uint32),
    ]


class LppvSize(Structure):
    _fields_ = [
        ("texels", c_uint32 * 3),
        ("bytes", c_size_t),
    ]


class LppvConstants(Structure):
    _fields_ = [
        ("local_from_world", c_float * 16),
        ("params", c_float * 4),
        ("low", c_float * 4),
        ("size_inverse", c_float * 4),
        ("shb_r", c_float * 4),
        ("shb_g", c_float * 4),
        ("shb_b", c_float * 4),
        ("shc", c_float * 4),
    ]


class LightmapsInfo(Structure):
    _fields_ = [
        ("page_size", c_uint32),
        ("page_count", c_uint32),
        ("instance_count", c_uint32),
        ("has_light", c_uint32),
        ("scale", c_float),
        ("mixed_lighting", c_uint32),
        ("has_ambient_occlusion", c_uint32),
    ]


class LightmapPlace(Structure):
    _fields_ = [
        ("scale", c_float * 2),
        ("offset", c_float * 2),
        ("page", c_uint32),
    ]


class ReflectionsInfo(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("level_count", c_uint32),
        ("probe_count", c_uint32),
    ]


class ReflectionProbe(Structure):
    _fields_ = [
        ("position", c_double * 3),
        ("box_center", c_float * 3),
        ("half_size", c_float * 3),
        ("axes", c_float * 9),
        ("blend_distance", c_float),
        ("importance", c_int32),
        ("validity", c_float),
    ]


class ReflectionBlend(Structure):
    _fields_ = [
        ("probes", c_uint32 * 3),
        ("weights", c_float * 3),
    ]


# Result and parameters of each function.
FUNCTIONS: dict[str, tuple[Any, list[Any]]] = {
    "tetralight_version": (c_uint32, []),
    "tetralight_version_string": (c_char_p, []),
    "tetralight_open": (c_int, [c_char_p, POINTER(c_void_p), POINTER(Error)]),
    "tetralight_open_lazy": (c_int, [c_char_p, POINTER(c_void_p), POINTER(Error)]),
    "tetralight_open_memory": (c_int, [c_void_p, c_size_t, POINTER(c_void_p), POINTER(Error)]),
    "tetralight_verify": (c_int, [c_void_p, POINTER(Error)]),
    "tetralight_close": (None, [c_void_p]),
    "tetralight_get_info": (c_int, [c_void_p, POINTER(Info), POINTER(Error)]),
    "tetralight_get_layer": (c_int, [c_void_p, c_uint32, POINTER(Layer), POINTER(Error)]),
    "tetralight_get_array": (c_int, [c_void_p, c_uint32, POINTER(ConstArray), POINTER(Error)]),
    "tetralight_get_details": (c_int, [c_void_p, POINTER(Details), POINTER(Error)]),
    "tetralight_get_scene_light": (c_int, [c_void_p, c_uint32, POINTER(SceneLight), POINTER(Error)]),
    "tetralight_recombine": (c_int, [c_void_p, c_void_p, c_size_t, POINTER(Error)]),
    "tetralight_relight_sky": (c_int, [c_void_p, c_void_p, POINTER(Error)]),
    "tetralight_relight_sun": (c_int, [c_void_p, c_void_p, c_void_p, POINTER(Error)]),
    "tetralight_save": (c_int, [c_void_p, c_char_p, POINTER(Error)]),
    "tetralight_query": (c_int, [c_void_p, c_void_p, c_void_p, POINTER(Light), POINTER(Error)]),
    "tetralight_query_batch": (c_int, [c_void_p, POINTER(Batch), POINTER(Report), POINTER(Error)]),
    "tetralight_pack_instances": (c_int, [c_void_p, POINTER(Instances), POINTER(Report), POINTER(Error)]),
    "tetralight_joined_create": (c_int, [POINTER(c_void_p), POINTER(Error)]),
    "tetralight_joined_destroy": (None, [c_void_p]),
    "tetralight_joined_add": (c_int, [c_void_p, c_char_p, c_void_p, POINTER(Error)]),
    "tetralight_joined_remove": (c_int, [c_void_p, c_char_p, POINTER(Error)]),
    "tetralight_joined_step": (c_int, [c_void_p, c_uint32, c_void_p, POINTER(Error)]),
    "tetralight_joined_commit": (c_int, [c_void_p, POINTER(Error)]),
    "tetralight_joined_volume": (c_void_p, [c_void_p]),
    "tetralight_pack_sh": (c_int, [c_void_p, c_void_p, POINTER(Error)]),
    "tetralight_sample_sh9": (c_int, [c_void_p, c_void_p, c_void_p, POINTER(Error)]),
    "tetralight_get_lppv_size": (c_int, [POINTER(LppvBox), POINTER(LppvSize), POINTER(Error)]),
    "tetralight_fill_lppv": (c_int, [c_void_p, POINTER(LppvBox), POINTER(Array), POINTER(LppvConstants), POINTER(Error)]),
    "tetralight_make_shader_volume": (c_int, [c_void_p, POINTER(c_void_p), POINTER(Error)]),
    "tetralight_get_shader_array": (c_int, [c_void_p, c_uint32, POINTER(ConstArray), POINTER(Error)]),
    "tetralight_free_shader_volume": (None, [c_void_p]),
    "tetralight_lightmaps_open": (c_int, [c_char_p, POINTER(c_void_p), POINTER(Error)]),
    "tetralight_lightmaps_open_memory": (c_int, [c_void_p, c_size_t, POINTER(c_void_p), POINTER(Error)]),
    "tetralight_lightmaps_close": (None, [c_void_p]),
    "tetralight_lightmaps_get_info": (c_int, [c_void_p, POINTER(LightmapsInfo), POINTER(Error)]),
    "tetralight_lightmaps_rectangle": (c_int, [c_void_p, c_uint32, POINTER(LightmapPlace), POINTER(Error)]),
    "tetralight_lightmaps_get_array": (c_int, [c_void_p, c_uint32, POINTER(ConstArray), POINTER(Error)]),
    "tetralight_lightmaps_sample": (c_int, [c_void_p, c_uint32, c_void_p, c_void_p, c_void_p, c_void_p, POINTER(Error)]),
    "tetralight_lightmaps_shadow_mask": (c_int, [c_void_p, c_uint32, c_void_p, c_void_p, POINTER(Error)]),
    "tetralight_lightmaps_ambient_occlusion": (c_int, [c_void_p, c_uint32, c_void_p, c_void_p, POINTER(Error)]),
    "tetralight_reflections_open": (c_int, [c_char_p, POINTER(c_void_p), POINTER(Error)]),
    "tetralight_reflections_open_memory": (c_int, [c_void_p, c_size_t, POINTER(c_void_p), POINTER(Error)]),
    "tetralight_reflections_close": (None, [c_void_p]),
    "tetralight_reflections_get_info": (c_int, [c_void_p, POINTER(ReflectionsInfo), POINTER(Error)]),
    "tetralight_reflections_get_probe": (c_int, [c_void_p, c_uint32, POINTER(ReflectionProbe), POINTER(Error)]),
    "tetralight_reflections_texels": (c_int, [c_void_p, c_uint32, POINTER(ConstArray), POINTER(Error)]),
    "tetralight_reflections_blend": (c_int, [c_void_p, c_void_p, POINTER(ReflectionBlend), POINTER(Error)]),
    "tetralight_reflections_sample": (c_int, [c_void_p, POINTER(ReflectionBlend), c_void_p, c_void_p, c_float, c_void_p, POINTER(Error)]),
    "tetralight_reflections_occlusion": (c_int, [c_void_p, POINTER(ReflectionBlend), c_void_p, c_void_p, c_float, c_void_p, POINTER(Error)]),
    "tetralight_split_sum": (c_int, [c_float, c_float, c_uint32, c_void_p, POINTER(Error)]),
}


def declare(library: ctypes.CDLL) -> None:
    """Gives the functions of a loaded library their types."""
    for name, (result, parameters) in FUNCTIONS.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = parameters
