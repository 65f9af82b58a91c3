# SPDX-License-Identifier: Apache-2.0
"""Run by Blender: exports light probe volumes to OUT/probes.glb, and writes their positions to OUT/expected.json."""
import json
import runpy
import sys
from pathlib import Path

import bpy

EXPORT = Path(__file__).resolve().parents[2] / "examples/blender/export_light_probes.py"


def add_volume(name, resolution, parent=None, **placement):
    bpy.ops.object.lightprobe_add(type="GRID", **placement)
    volume = bpy.context.object
    volume.name = name
    volume.parent = parent
    volume.data.grid_resolution_x, volume.data.grid_resolution_y, volume.data.grid_resolution_z = resolution
    return volume


def positions(volume, resolution):
    """The centres of the cells of the volume's cube, from -1 to 1, in glTF's axes."""
    from mathutils import Vector
    cells = [[-1 + (2 * i + 1) / count for i in range(count)] for count in resolution]
    places = [volume.matrix_world @ Vector((x, y, z)) for x in cells[0] for y in cells[1] for z in cells[2]]
    return [[place.x, place.z, -place.y] for place in places]


def main():
    out = Path(sys.argv[sys.argv.index("--") + 1])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.object.empty_add(location=(3, -1, 2), rotation=(0.3, -0.2, 0.9), scale=(1, 1, 1))
    parent = bpy.context.object
    parent.name = "Level"
    parent.scale = (2, 2, 2)
    resolutions = {"Hall": (3, 4, 2), "Tower": (1, 2, 5)}
    volumes = {
        "Hall": add_volume("Hall", resolutions["Hall"], location=(1, 2, 3), rotation=(0.1, 0.2, 0.3)),
        "Tower": add_volume("Tower", resolutions["Tower"], parent, location=(-4, 0, 1), rotation=(0, 0, 0.5))}
    volumes["Hall"].scale = (4, 5, 1.5)
    volumes["Tower"].scale = (1, 2, 6)
    bpy.ops.object.lightprobe_add(type="CUBEMAP", location=(9, 9, 9))
    bpy.context.view_layer.update()
    expected = {name: positions(volume, resolutions[name]) for name, volume in volumes.items()}
    (out / "expected.json").write_text(json.dumps(expected))
    sys.argv = sys.argv[:sys.argv.index("--")] + ["--", str(out / "probes.glb")]
    runpy.run_path(str(EXPORT), run_name="__main__")


main()
