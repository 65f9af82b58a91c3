# SPDX-License-Identifier: Apache-2.0
"""Writes a scene as binary glTF with the units and extras that Tetralight reads.

Blender's exporter writes the file. What it leaves out is added to the file, so that the scene in Blender does not
change: area lights, the sizes of lamps, and the colour of the world.
"""
from pathlib import Path

import bpy

from . import light_units
from .gltf_file import read_glb, write_glb
from .settings import KEY
from .show_probes import keep_out_of_renders
from .world import sky_of

PUNCTUAL = "KHR_lights_punctual"

# Settings of the exporter. A setting with several names is the first that this version of Blender has.
EXPORTER_SETTINGS = (
    (("export_format",), "GLB"),
    (("export_extras",), True),
    (("export_lights",), True),
    (("export_cameras",), True),
    (("export_yup",), True),
    (("export_apply",), True),
    (("use_mesh_vertices",), True),  # loose points: probes
    (("use_renderable",), True),
    (("use_active_scene",), True),
    (("export_import_convert_lighting_mode", "convert_lighting_mode"), "COMPAT"),
    (("export_animations",), False),
    (("export_current_frame",), True),
    (("export_skins",), False),  # meshes as they are posed
    (("export_morph",), True),  # shape keys of meshes without modifiers, with their values
    (("will_save_settings",), False),
)
# The vertex colours count in glTF, although no node of the material reads them.
VERTEX_COLORS = {"export_colors": (False, True), "export_vertex_color": ("NONE", "MATERIAL")}


class ExportError(Exception):
    """The scene cannot be exported, with a message for the user."""


def write_scene(context, path):
    """Writes the scene to a .glb file. Returns warnings: what the file does not hold of the scene."""
    scene = context.scene
    keep_out_of_renders(scene)
    _run_exporter(path, scene)
    try:
        document, chunks = read_glb(Path(path))
        warnings = complete(document, scene)
        write_glb(Path(path), document, chunks)
    except (OSError, ValueError) as error:
        raise ExportError(f"the exported scene cannot be completed: {error}") from error
    return warnings


def _run_exporter(path, scene):
    try:
        known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
    except (AttributeError, KeyError) as error:
        raise ExportError("Blender's add-on for glTF 2.0 is off: enable it in the preferences") from error
    settings = {}
    for names, value in EXPORTER_SETTINGS:
        name = next((name for name in names if name in known), None)
        if name:
            settings[name] = value
    for name, values in VERTEX_COLORS.items():
        if name in known:
            settings[name] = values[_reads_vertex_colors(scene)]
    try:
        bpy.ops.export_scene.gltf(filepath=str(path), **settings)
    except (RuntimeError, ImportError) as error:
        raise ExportError(f"Blender's glTF exporter failed: {_last_line(error)}") from error


def _last_line(error):
    """The exception at the end of the traceback that Blender gives as a text."""
    lines = [line for line in str(error).split("\n") if line.strip() and not line.startswith("Location:")]
    return lines[-1] if lines else "no reason given"


def _reads_vertex_colors(scene):
    """True if a material of the scene has a node that reads a colour attribute."""
    materials = {slot.material for thing in scene.objects for slot in thing.material_slots if slot.material}
    trees = [material.node_tree for material in materials if material.use_nodes and material.node_tree]
    return any(node.type in ("VERTEX_COLOR", "ATTRIBUTE") for tree in trees for node in tree.nodes)


def complete(document, scene):
    """Adds to a glTF document what the exporter left out of it. Returns warnings."""
    warnings = []
    _complete_sky(document, scene, warnings)
    lights = _lights_by_name(warnings)
    _complete_lamps(document, lights, scene.tetralight.soft_shadows, warnings)
    _add_area_lights(document, scene, warnings)
    return warnings


def _complete_sky(document, scene, warnings):
    sky = sky_of(scene)
    if sky.problem:
        warnings.append(sky.problem)
    for exported in document.get("scenes", []):
        extras = exported.setdefault("extras", {})
        extras.pop(KEY, None)
        if sky.radiance:
            extras["sky"] = {"radiance": sky.radiance}
        if not extras:
            del exported["extras"]


def _lights_by_name(warnings):
    lights = {}
    for light in bpy.data.lights:
        if lights.setdefault(light.name, light) != light:
            warnings.append(f'several lights have the name "{light.name}": each gets the power of the first')
    return lights


def _complete_lamps(document, lights, has_size, warnings):
    for exported in document.get("extensions", {}).get(PUNCTUAL, {}).get("lights", []):
        light = lights.get(exported.get("name"))
        if light is None:
            continue
        if not light_units.is_exported_whole(light):
            warnings.append(f'light "{light.name}": its nodes are left out')
        exported["intensity"] = light_units.intensity_of(light)
        exported["color"] = light_units.color_of(light)
        if has_size:
            exported["extras"] = {**light_units.size_extras(light), **exported.get("extras", {})}


def _add_area_lights(document, scene, warnings):
    """A light for each node of an area light, which the exporter writes without its light."""
    places = {thing.name: thing for thing in bpy.data.objects if thing.type == "LIGHT" and thing.data.type == "AREA"}
    for node in document.get("nodes", []):
        place = places.get(node.get("name"))
        if place is None or "mesh" in node or "camera" in node or PUNCTUAL in node.get("extensions", {}):
            continue
        if not light_units.is_exported_whole(place.data):
            warnings.append(f'light "{place.data.name}": its nodes are left out')
        _warn_of_shape(place, warnings)
        index = _add_light(document, place)
        node.setdefault("extensions", {})[PUNCTUAL] = {"light": index}


def _add_light(document, place):
    light = place.data
    custom = {name: light[name] for name in ("mode", "indirect_multiplier") if name in light.keys()}
    lights = document.setdefault("extensions", {}).setdefault(PUNCTUAL, {}).setdefault("lights", [])
    lights.append({
        "name": light.name,
        "type": "point",
        "color": light_units.color_of(light),
        "intensity": light_units.intensity_of(light),
        "extras": {**custom, **light_units.area_extras(light, place.matrix_world.to_scale())},
    })
    if PUNCTUAL not in document.setdefault("extensionsUsed", []):
        document["extensionsUsed"].append(PUNCTUAL)
    return len(lights) - 1


def _warn_of_shape(place, warnings):
    light = place.data
    if light.shape == "ELLIPSE":
        warnings.append(f'area light "{light.name}": the ellipse is exported as a rectangle of its area')
    if getattr(light, "spread", 3.2) < 3.1:
        warnings.append(f'area light "{light.name}": its spread is left out')
