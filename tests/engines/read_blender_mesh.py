# SPDX-License-Identifier: Apache-2.0
"""Writes what Blender holds of an object as JSON; runs in Blender: -- OBJECT FILE"""
import json
import sys

import bpy

name, path = sys.argv[sys.argv.index("--") + 1:]
probes = bpy.data.objects[name]
bpy.context.view_layer.update()
mesh = probes.data
# The others are what Blender adds itself.
attributes = [a for a in mesh.attributes if not a.name.startswith(".") and a.name != "position"]


def values(attribute):
    member = {"FLOAT": "value", "INT": "value", "FLOAT_COLOR": "color", "FLOAT_VECTOR": "vector"}[attribute.data_type]
    found = [getattr(element, member) for element in attribute.data]
    return found if member == "value" else [list(value) for value in found]


with open(path, "w") as file:
    json.dump({"positions": [list(probes.matrix_world @ vertex.co) for vertex in mesh.vertices],
               "groups": json.loads(probes["probe_groups"]),
               "active_color": mesh.attributes.active_color.name,
               "domains": sorted({attribute.domain for attribute in attributes}),
               "attributes": {attribute.name: values(attribute) for attribute in attributes}}, file)
