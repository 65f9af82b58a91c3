# SPDX-License-Identifier: Apache-2.0
"""Exports a scene with its light probe volumes as probe groups.

    blender -b SCENE.blend --python-exit-code 1 --python export_light_probes.py -- OUT.glb

Blender's glTF exporter writes a light probe volume (an "Irradiance Volume" in Blender 3.4) as a node without its
resolution. This script copies the resolution into custom properties of the object, which are exported, and exports. A
volume that already has the property light_probe_group is left as it is.
"""
import sys

import bpy


def mark_volumes():
    for thing in bpy.context.scene.objects:
        if thing.type != "LIGHT_PROBE" or thing.data.type not in ("GRID", "VOLUME") or "light_probe_group" in thing:
            continue
        volume = thing.data
        thing["light_probe_group"] = 1
        # The exporter turns Blender's z up into glTF's y.
        thing["probe_resolution"] = [volume.grid_resolution_x, volume.grid_resolution_z, volume.grid_resolution_y]


def export(path):
    options = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
    lighting = next(name for name in ("export_import_convert_lighting_mode", "convert_lighting_mode") if name in options)
    bpy.ops.export_scene.gltf(filepath=path, export_extras=True, export_lights=True, export_cameras=True,
                              **{lighting: "COMPAT"})  # watts stay watts


if __name__ == "__main__":
    mark_volumes()
    export(sys.argv[sys.argv.index("--") + 1])
