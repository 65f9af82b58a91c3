# SPDX-License-Identifier: Apache-2.0
"""Shows the probes of a volume as balls with the colour of their light.

The colour of a vertex is what a white surface with its normal shows: irradiance / π. It is the colour attribute
`light`, linear. The balls are one object in the collection "Tetralight probes", which renders and exports leave out.
"""
import math

import bpy
import numpy

COLLECTION = "Tetralight probes"
MARK = "tetralight_display"  # custom property of the collection and of the object
ATTRIBUTE = "light"
MOST_SMOOTH_BALLS = 2000  # more probes have balls of fewer vertices


def show_probes(scene, probes, name, radius, exposure):
    """Replaces what is shown in the scene. Returns the object."""
    hide_probes(scene)
    normals, faces = ball(4 if len(probes) <= MOST_SMOOTH_BALLS else 1)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(*_balls(probes, normals, faces, radius))
    colors = mesh.color_attributes.new(name=ATTRIBUTE, type="FLOAT_COLOR", domain="POINT")
    colors.data.foreach_set("color", _colors(probes, normals, exposure).ravel())
    mesh.materials.append(_material())
    mesh.update()
    shown = bpy.data.objects.new(name, mesh)
    shown[MARK] = 1
    shown.hide_render = shown.hide_select = True
    _collection(scene).objects.link(shown)
    return shown


def hide_probes(scene):
    """Removes what `show_probes` has made."""
    for thing in [thing for thing in scene.objects if MARK in thing.keys()]:
        mesh = thing.data
        bpy.data.objects.remove(thing)
        if mesh and not mesh.users:
            bpy.data.meshes.remove(mesh)


def shown_probes(scene):
    """The object that shows probes, or None."""
    return next((thing for thing in scene.objects if MARK in thing.keys()), None)


def keep_out_of_renders(scene):
    """Exports leave out what is not rendered: hides the balls from both, if the user shows them in renders."""
    for thing in scene.objects:
        if MARK in thing.keys() and not thing.hide_render:
            thing.hide_render = True


def blender_from_gltf(vectors):
    """Y up to Z up."""
    x, y, z = numpy.asarray(vectors).T
    return numpy.stack([x, -z, y], axis=1)


def gltf_from_blender(vectors):
    x, y, z = numpy.asarray(vectors).T
    return numpy.stack([x, z, -y], axis=1)


def ball(rings):
    """Unit vectors and triangles of a ball: poles, and 2 · rings + 2 vertices on each ring."""
    segments = 2 * rings + 2
    normals = [(0.0, 0.0, 1.0)]
    for ring in range(1, rings + 1):
        polar = math.pi * ring / (rings + 1)
        for segment in range(segments):
            around = 2 * math.pi * segment / segments
            normals.append((math.sin(polar) * math.cos(around), math.sin(polar) * math.sin(around), math.cos(polar)))
    normals.append((0.0, 0.0, -1.0))
    last = len(normals) - 1
    faces = []
    for segment in range(segments):
        following = (segment + 1) % segments
        faces.append((0, 1 + segment, 1 + following))
        for ring in range(rings - 1):
            a, b = 1 + ring * segments, 1 + (ring + 1) * segments
            faces.append((a + segment, b + segment, b + following))
            faces.append((a + segment, b + following, a + following))
        faces.append((last, last - segments + following, last - segments + segment))
    return numpy.array(normals), numpy.array(faces)


def _balls(probes, normals, faces, radius):
    """Vertices, edges and faces of all balls."""
    centers = blender_from_gltf(probes.positions)
    vertices = (centers[:, None, :] + radius * normals[None, :, :]).reshape(-1, 3)
    first = numpy.arange(len(probes))[:, None, None] * len(normals)
    return vertices.tolist(), [], (first + faces[None, :, :]).reshape(-1, 3).tolist()


def _colors(probes, normals, exposure):
    """RGBA of each vertex, n · m × 4."""
    light = probes.irradiance(gltf_from_blender(normals)) / math.pi * 2.0**exposure
    rgba = numpy.ones((*light.shape[:2], 4), dtype=numpy.float32)
    rgba[:, :, :3] = numpy.maximum(light, 0.0)
    return rgba


def _collection(scene):
    for collection in scene.collection.children_recursive:
        if MARK in collection.keys():
            return collection
    collection = bpy.data.collections.new(COLLECTION)
    collection[MARK] = 1
    collection.hide_render = True
    scene.collection.children.link(collection)
    return collection


def _material():
    """Glows in the colour of the attribute."""
    for material in bpy.data.materials:
        if MARK in material.keys() and material.library is None:
            return material
    material = bpy.data.materials.new(COLLECTION)
    material[MARK] = 1
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    color = nodes.new("ShaderNodeVertexColor")
    color.layer_name = ATTRIBUTE
    glow = nodes.new("ShaderNodeEmission")
    output = nodes.new("ShaderNodeOutputMaterial")
    links.new(color.outputs["Color"], glow.inputs["Color"])
    links.new(glow.outputs["Emission"], output.inputs["Surface"])
    return material
