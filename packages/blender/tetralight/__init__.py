# SPDX-License-Identifier: Apache-2.0
"""Tetralight in Blender: marks what a bake needs, exports, bakes and shows the probes. docs/blender.md describes it.

    marks, settings, preferences       what the user sets: with objects, with the scene, with Blender
    export, light_units, world, gltf_file  the scene as glTF with the units and extras of Tetralight
    baking, service                    a bake by the command or the service, in a thread
    probe_file, show_probes            a volume as balls in the colour of their light
    operators, panels                  what the user sees
"""
from . import marks, operators, panels, preferences, settings

bl_info = {
    "name": "Tetralight",
    "description": "Bakes light probes, and shows them",
    "author": "The Tetralight authors",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Tetralight",
    "category": "Render",
}

MODULES = (preferences, settings, marks, operators, panels)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
