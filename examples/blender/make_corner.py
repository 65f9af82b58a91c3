# SPDX-License-Identifier: Apache-2.0
"""Puts Blender's default cube into the corner of a room, and exports the scene for Tetralight.

    blender -b --factory-startup --python-exit-code 1 --python make_corner.py -- [OUT.glb]

The cube moves: probes light it, and the bake does not see it. docs/scenes.md has the same steps as clicks.
"""
import sys

import bpy

LIGHTING = "COMPAT"  # "Unitless" in the dialog: watts stay watts


def add_material(name, color, emission=0.0):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    surface = material.node_tree.nodes["Principled BSDF"].inputs
    surface["Base Color"].default_value = (*color, 1)
    surface["Roughness"].default_value = 0.9
    surface["Emission"].default_value = (*color, 1)
    surface["Emission Strength"].default_value = emission
    return material


def add_box(name, size, center, material):
    bpy.ops.mesh.primitive_cube_add(size=1, location=center, scale=size)
    box = bpy.context.object
    box.name = name
    box.data.materials.append(material)
    return box


def add_empty(name, location, parent=None):
    empty = bpy.data.objects.new(name, None)
    empty.location = location
    empty.parent = parent
    bpy.context.scene.collection.objects.link(empty)
    return empty


def add_room():
    grey = add_material("grey", (0.7, 0.7, 0.68))
    add_box("floor", (12, 12, 0.2), (2.9, -1.9, -1.1), grey)
    add_box("wall_left", (0.2, 12, 5.2), (-3.2, -1.9, 1.4), add_material("red", (0.75, 0.12, 0.06)))
    add_box("wall_back", (12, 0.2, 5.2), (2.9, 4.2, 1.4), grey)
    add_box("step", (4, 0.8, 0.6), (-0.4, 3.3, -0.7), add_material("green", (0.15, 0.4, 0.2)))
    add_box("tube", (0.12, 4, 0.12), (-3.04, -1, 1.3), add_material("glow", (0.3, 0.6, 1), emission=6))


def add_probes():
    """A probe every 2 m: the children of an empty with the property light_probe_group."""
    group = add_empty("corner", (0, 0, 0))
    group["light_probe_group"] = True
    for x in (-2.8, -0.8, 1.2, 3.2, 5.2):
        for y in (-5.3, -3.3, -1.3, 0.7, 2.7):
            for z in (-0.8, 1, 3):
                add_empty("probe", (x, y, z), parent=group)


def main():
    out = sys.argv[sys.argv.index("--") + 1] if "--" in sys.argv else "corner.glb"
    bpy.data.objects["Cube"]["contribute_gi"] = False
    bpy.data.objects["Cube"].rotation_euler.z = 0.3
    bpy.data.cameras["Camera"].lens = 32
    bpy.context.scene["sky"] = {"radiance": [0.1, 0.13, 0.2]}
    add_room()
    add_probes()
    bpy.ops.export_scene.gltf(filepath=out, export_format="GLB", export_lights=True, export_cameras=True,
                              export_extras=True, export_yup=True, convert_lighting_mode=LIGHTING)


if __name__ == "__main__":
    main()
