# SPDX-License-Identifier: Apache-2.0
"""Run by Blender: exports scenes of one light each and one probe 1 m above the origin, for test_blender.py.

    blender -b --python blender_lights.py -- FOLDER
"""
import math
import sys
from pathlib import Path

import bpy

FOLDER = Path(sys.argv[-1])


def add(name, data=None, location=(0, 0, 0), parent=None):
    thing = bpy.data.objects.new(name, data)
    thing.location = location
    thing.parent = parent
    bpy.context.scene.collection.objects.link(thing)
    return thing


def new_scene():
    """A scene with a probe, which is all that it has."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    group = add("group")
    group["light_probe_group"] = True
    add("probe", location=(0, 0, 1), parent=group)


def add_light(kind, strength, mode, **place):
    light = bpy.data.lights.new(kind, kind)
    light.energy = strength
    light["mode"] = mode
    return add(kind, light, **place)


def add_floor(emission):
    bpy.ops.mesh.primitive_plane_add(size=400)
    material = bpy.data.materials.new("floor")
    material.use_nodes = True
    surface = material.node_tree.nodes["Principled BSDF"].inputs
    surface["Emission"].default_value = (1, 1, 1, 1)
    surface["Emission Strength"].default_value = emission
    bpy.context.object.data.materials.append(material)


def export(name, lighting="COMPAT"):
    bpy.ops.export_scene.gltf(filepath=str(FOLDER / f"{name}.glb"), export_lights=True, export_extras=True,
                              convert_lighting_mode=lighting)


new_scene()
add_light("SUN", 3, "baked").rotation_euler.x = math.radians(60)
export("sun")
export("sun_standard", "SPEC")
export("sun_raw", "RAW")

for kind in ("POINT", "SPOT"):
    new_scene()
    add_light(kind, 1000, "baked", location=(0, 0, 3))
    export(kind.lower())
    export(f"{kind.lower()}_standard", "SPEC")
    export(f"{kind.lower()}_raw", "RAW")

new_scene()
add_floor(emission=2)
export("emission")
export("emission_standard", "SPEC")

new_scene()
add_floor(emission=0)
add_light("SUN", 3, "mixed")
export("bounce")

new_scene()
bpy.context.scene["sky"] = {"radiance": [0.05, 0.05, 0.05]}
export("sky")
bpy.context.scene["sky"] = [0.05, 0.05, 0.05]
export("sky_array")
bpy.context.scene["sky"] = 0.05
export("sky_number")
bpy.context.scene["sky"] = '{"radiance": [0.05, 0.05, 0.05]}'
export("sky_text")
