# SPDX-License-Identifier: Apache-2.0
"""Variants of nodes, animations, lights, extensions and files."""
import base64
import json
import math

from gltf_scene import (
    BYTE, FLOAT, HALF, OTHER, PAINT, PLACE, SHORT, UBYTE, USHORT, box_mesh, deformed_box, flat_png, glb, linear,
    material, matrix, moved_box, multiply, no_box, packed, plain, reversed_box, textured, transformed, turn)
from gltf_mesh_variants import glowing, white_box
from gltf_variant import variant, variants


# Nodes and scenes
@variant("a matrix", wrong=lambda: moved_box())
def _():
    return moved_box(matrix(**PLACE))


MIRRORED = [[-p[0], p[1], p[2]] for p in box_mesh()[0]]


@variant("a mirrored node", wrong=reversed_box)
def _():
    gltf, indices = plain(positions=MIRRORED), box_mesh()[3]
    gltf.box["attributes"].pop("NORMAL")
    gltf.box["indices"] = gltf.accessor([i for t in range(0, 36, 3) for i in indices[t:t + 3][::-1]], USHORT)
    gltf.node("box")["scale"] = [-1, 1, 1]
    return gltf


SHEAR = [1, 0, 0, 0, 0.4, 1, 0, 0, 0, 0.2, 1, 0, 0, 0, 0, 1]


@variant("a sheared node", twin=lambda: plain(positions=transformed(SHEAR, box_mesh()[0])), wrong=plain)
def _():
    return moved_box(multiply(matrix(**PLACE), SHEAR))


@variant("a deep hierarchy", wrong=lambda: moved_box())
def _():
    gltf = plain()
    node = gltf.node("box")
    steps, place = 50, node.pop("translation")
    rotation = node.pop("rotation")
    node.pop("mesh")
    for step in range(steps):
        child = gltf.add("nodes", {"name": f"step {step}", "translation": [c / steps for c in place]})
        node["children"] = [child]
        node = gltf.json["nodes"][child]
    node.update(rotation=rotation, mesh=1)
    return gltf


@variant("a scaled parent", wrong=lambda: no_scale())
def _():
    gltf = no_scale()
    gltf.node("parent")["scale"] = [0.5, 0.5, 0.5]
    return gltf


def no_scale():
    """The box of twice its size, below a node that halves it in the variant."""
    gltf = plain(positions=[[2 * c for c in p] for p in box_mesh()[0]])
    node = gltf.node("box")
    parent = gltf.add("nodes", {"name": "parent", "children": [gltf.index("box")]})
    node["translation"] = [2 * c for c in node["translation"]]
    gltf.json["scenes"][0]["nodes"][1] = parent
    return gltf


SECOND = {"translation": [1.2, 0.4, 0.5], "rotation": turn((0, 1, 0), 20), "scale": [0.5, 1, 0.5]}


@variant("a mesh of two nodes", twin=lambda: two_boxes(), wrong=plain)
def _():
    gltf = plain()
    gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "second", "mesh": 1, **SECOND}))
    return gltf


def two_boxes():
    gltf = plain()
    mesh = gltf.add("meshes", {"name": "moved", "primitives": [{
        "attributes": {"POSITION": gltf.accessor(transformed(matrix(**SECOND), box_mesh()[0]))},
        "indices": gltf.accessor(box_mesh()[3], USHORT), "material": 1}]})
    gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "second", "mesh": mesh}))
    return gltf


def instanced(component=FLOAT, names=("TRANSLATION", "ROTATION", "SCALE"), **more):
    gltf = plain()
    node = gltf.node("box")
    values = {"TRANSLATION": [PLACE["translation"], SECOND["translation"]],
              "ROTATION": [PLACE["rotation"], SECOND["rotation"]], "SCALE": [[1, 1, 1], SECOND["scale"]]}
    for member in ("translation", "rotation"):
        del node[member]
    attributes = {}
    for name in names:
        if component != FLOAT and name == "ROTATION":
            steps = [[round(32767 * c) for c in v] for v in values[name]]
            attributes[name] = gltf.accessor(steps, SHORT, normalized=True)
        else:
            attributes[name] = gltf.accessor(values[name])
    gltf.extension("EXT_mesh_gpu_instancing", node, {"attributes": attributes}, required=True)
    return gltf


@variant("instances", twin=two_boxes, wrong=plain)
def _():
    return instanced()


@variant("instances with rotations of 16 bits", twin=two_boxes, wrong=plain, tolerance=2e-3)
def _():
    return instanced(SHORT)


@variant("instances with an attribute of a program", twin=two_boxes, wrong=plain)
def _():
    gltf = instanced()
    attributes = gltf.node("box")["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
    attributes["_ID"] = gltf.accessor([1, 2])
    return gltf


def extra_box(**members):
    """Another large box above the probes, in a node with these members."""
    gltf = plain()
    node = gltf.add("nodes", {"name": "hidden", "mesh": 1, "translation": [0, 1.8, 0], **members})
    return gltf, node


def visible_extra_box():
    gltf, node = extra_box(scale=[2, 0.3, 4])
    gltf.json["scenes"][0]["nodes"].append(node)
    return gltf


@variant("a hidden node", wrong=visible_extra_box)
def _():
    gltf = visible_extra_box()
    gltf.extension("KHR_node_visibility", gltf.node("hidden"), {"visible": False})
    return gltf


@variant("a visible child of a hidden node", wrong=visible_extra_box)
def _():
    gltf, node = extra_box(scale=[2, 0.3, 4])
    gltf.extension("KHR_node_visibility", gltf.json["nodes"][node], {"visible": True})
    parent = gltf.add("nodes", {"name": "parent", "children": [node]})
    gltf.extension("KHR_node_visibility", gltf.json["nodes"][parent], {"visible": False})
    gltf.json["scenes"][0]["nodes"].append(parent)
    return gltf


@variant("a hidden light", twin=lambda: no_lamp(), wrong=plain)
def _():
    gltf = plain()
    gltf.extension("KHR_node_visibility", gltf.node("lamp"), {"visible": False})
    return gltf


def no_lamp():
    gltf = plain()
    gltf.node("lamp").pop("extensions")
    return gltf


def two_scenes():
    gltf, node = extra_box(scale=[2, 0.3, 4])
    gltf.add("scenes", {"name": "second", "nodes": [0, 1, 2, 3, 4, node]})
    return gltf


@variant("several scenes: the first is the default", wrong=visible_extra_box)
def _():
    return two_scenes()


@variant("several scenes: the second is the default", twin=visible_extra_box, wrong=plain)
def _():
    gltf = two_scenes()
    gltf.json["scene"] = 1
    return gltf


@variant("several scenes without a default", told="other scenes")
def _():
    gltf = two_scenes()
    del gltf.json["scene"]
    return gltf


@variant("one scene without a default")
def _():
    gltf = plain()
    del gltf.json["scene"]
    return gltf


@variant("several scenes: one by its name", twin=visible_extra_box, wrong=plain, options=("--scene-name", "second"))
def _():
    return two_scenes()


@variant("no scenes")
def _():
    gltf = plain()
    del gltf.json["scene"]
    del gltf.json["scenes"]
    return gltf


@variant("nodes outside of the scene", told="nodes outside of the scene")
def _():
    return extra_box(scale=[2, 0.3, 4])[0]


@variant("MSFT_lod", told="MSFT_lod")
def _():
    gltf, node = extra_box(scale=[2, 0.3, 4])
    gltf.extension("MSFT_lod", gltf.node("box"), {"ids": [node]})
    return gltf


@variant("a matrix beside a translation", refused="matrix")
def _():
    gltf = plain()
    gltf.node("box")["matrix"] = matrix((0, 2, 0))
    return gltf


@variant("a node with two parents", refused="two parents")
def _():
    gltf = plain()
    for _ in range(2):
        gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "parent", "children": [1]}))
    gltf.json["scenes"][0]["nodes"].remove(1)
    return gltf


@variant("a rotation that is not a unit quaternion", wrong=no_box, tolerance=1e-3)
def _():
    return moved_box(translation=PLACE["translation"], rotation=[2 * c for c in PLACE["rotation"]])


@variant("instances with children", twin=lambda: two_boxes(), wrong=plain)
def _():
    gltf = instanced(names=("TRANSLATION", "ROTATION", "SCALE"))
    gltf.node("box")["children"] = [gltf.add("nodes", {"name": "empty", "translation": [9, 9, 9]})]
    return gltf


@variant("instances with colours", twin=lambda: two_boxes(), told="_COLOR_0")
def _():
    gltf = instanced()
    attributes = gltf.node("box")["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
    attributes["_COLOR_0"] = gltf.accessor([[1, 0, 0], [0, 0, 1]])
    return gltf


@variant("instances in a node with a transform", twin=lambda: two_boxes(), wrong=plain)
def _():
    gltf = instanced()
    parent = gltf.add("nodes", {"name": "parent", "children": [1], "translation": [0, 1, 0]})
    gltf.node("box")["translation"] = [0, -1, 0]
    gltf.json["scenes"][0]["nodes"][1] = parent
    return gltf


@variant("two materials of one mesh", wrong=plain, twin=lambda: half_painted())
def _():
    gltf, indices = plain(), box_mesh()[3]
    gltf.add("materials", material("other", linear(OTHER)))
    gltf.box["indices"] = gltf.accessor(indices[:18], USHORT)
    gltf.json["meshes"][1]["primitives"].append({**gltf.box, "material": 2,
                                                 "indices": gltf.accessor(indices[18:], USHORT)})
    return gltf


def half_painted():
    gltf = plain(color=[1, 1, 1])
    colors = [linear(PAINT if i < 12 else OTHER) for i in range(24)]
    gltf.box["attributes"]["COLOR_0"] = gltf.accessor(colors)
    return gltf


# Deformation and animation
def stretch(p):
    return [p[0] * 1.2, p[1] * 1.4, p[2] * 0.8]


def morphed(weight_of):
    gltf, positions = plain(), box_mesh()[0]
    offsets = [[2 * (b - a) for a, b in zip(p, stretch(p))] for p in positions]
    gltf.box["targets"] = [{"POSITION": gltf.accessor(offsets)}, {"POSITION": gltf.accessor([[5, 0, 0]] * 24)}]
    weight_of(gltf)
    return gltf


def stretched():
    return deformed_box(stretch)


@variant("morph weights of a mesh", twin=stretched, wrong=plain)
def _():
    return morphed(lambda gltf: gltf.json["meshes"][1].update(weights=[0.5, 0]))


@variant("morph weights of a node", twin=stretched, wrong=plain)
def _():
    def weights(gltf):
        gltf.json["meshes"][1].update(weights=[0, 1])
        gltf.node("box")["weights"] = [0.5, 0]
    return morphed(weights)


@variant("quantized morph targets", twin=lambda: deformed_box(lambda p: [p[0], p[1] * 1.5, p[2]]), wrong=plain,
         tolerance=1e-3)
def _():
    gltf, positions = plain(), box_mesh()[0]
    steps = [[0, 127 if p[1] > 0 else -127, 0, 0] for p in positions]
    view = gltf.view(packed(steps, BYTE), byteStride=4)
    target = gltf.accessor([s[:3] for s in steps], BYTE, view=view, normalized=True)
    gltf.box["targets"] = [{"POSITION": target}]
    gltf.json["meshes"][1]["weights"] = [HALF[1] / 2]
    gltf.extension("KHR_mesh_quantization", required=True)
    return gltf


@variant("morphed colours", told="morphed COLOR_0")
def _():
    gltf = morphed(lambda g: g.json["meshes"][1].update(weights=[0, 0]))
    gltf.box["attributes"]["COLOR_0"] = gltf.accessor([[1, 1, 1]] * 24)
    for target in gltf.box["targets"]:
        target["COLOR_0"] = gltf.accessor([[-1, 0, 0]] * 24)
    return gltf


def skinned(component=FLOAT):
    """The box moved by a joint; the transform of its own node does not count."""
    gltf, count = plain(), len(box_mesh()[0])
    x, y, z = PLACE["translation"]
    gltf.node("box").update(translation=[5, 5, 5], skin=0)
    joints = [gltf.add("nodes", {"name": "joint 0", **PLACE, "translation": [x, y + 1, z]}),
              gltf.add("nodes", {"name": "joint 1", "translation": [9, 9, 9]})]
    gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "armature", "children": list(joints)}))
    gltf.json["skins"] = [{"joints": joints, "inverseBindMatrices": gltf.accessor([matrix((0, -1, 0)), matrix()])}]
    gltf.box["attributes"]["JOINTS_0"] = gltf.accessor([[0, 1, 0, 0]] * count, UBYTE)
    one = {FLOAT: 1, UBYTE: 255, USHORT: 65535}[component]
    members = {} if component == FLOAT else {"normalized": True}
    gltf.box["attributes"]["WEIGHTS_0"] = gltf.accessor([[one, 0, 0, 0]] * count, component, **members)
    return gltf


@variants({"float": FLOAT, "u8": UBYTE, "u16": USHORT}, "a skin with weights of {}", wrong=no_box)
def _(component):
    return skinned(component=component)


@variant("a skin with weights that are not normal", wrong=no_box)
def _():
    gltf = skinned()
    gltf.box["attributes"]["WEIGHTS_0"] = gltf.accessor([[0.5, 0, 0, 0]] * 24)
    return gltf


@variant("a skin with a second set of joints", wrong=no_box)
def _():
    gltf = skinned()
    gltf.box["attributes"]["WEIGHTS_0"] = gltf.accessor([[0, 0, 0, 0]] * 24)
    gltf.box["attributes"]["JOINTS_1"] = gltf.accessor([[0, 0, 0, 0]] * 24, UBYTE)
    gltf.box["attributes"]["WEIGHTS_1"] = gltf.accessor([[1, 0, 0, 0]] * 24)
    return gltf


@variant("a third set of joints", told="JOINTS_2")
def _():
    gltf = skinned()
    for name in ("JOINTS_1", "WEIGHTS_1"):
        gltf.box["attributes"][name] = gltf.box["attributes"][name[:-1] + "0"]
    gltf.box["attributes"]["JOINTS_2"] = gltf.accessor([[0, 0, 0, 0]] * 24, UBYTE)
    gltf.box["attributes"]["WEIGHTS_2"] = gltf.accessor([[0, 0, 0, 0]] * 24)
    return gltf


@variant("a skin of a mesh without joints", told="skins of meshes without joints")
def _():
    gltf = plain()
    gltf.json["skins"] = [{"joints": [0]}]
    gltf.node("box")["skin"] = 0
    return gltf


RAISED = {**PLACE, "translation": [0.3, 2, -0.2]}


def raised():
    return moved_box(**RAISED)


def animated(path, values, times=(0, 2), mode="LINEAR", node="box", make=plain):
    gltf = make()
    gltf.json["animations"] = [{"name": "move", "samplers": [
        {"input": gltf.accessor(list(times)), "output": gltf.accessor(values), "interpolation": mode}],
        "channels": [{"sampler": 0, "target": {"node": gltf.index(node), "path": path}}]}]
    return gltf


PATH = [PLACE["translation"], [0.3, 3.6, -0.2]]
AT_ONE = ("--time", "1")


@variant("an animation without a time", told="animation")
def _():
    return animated("translation", PATH)


@variant("an animation: LINEAR", twin=raised, wrong=plain, options=AT_ONE)
def _():
    return animated("translation", PATH)


@variant("an animation: STEP", wrong=raised, options=AT_ONE)
def _():
    return animated("translation", PATH, mode="STEP")


@variant("an animation: CUBICSPLINE", twin=raised, wrong=plain, options=AT_ONE)
def _():  # without tangents, the middle of both values
    still = [0, 0, 0]
    return animated("translation", [still, PATH[0], still, still, PATH[1], still], mode="CUBICSPLINE")


@variant("an animation: rotation", twin=lambda: moved_box(translation=PLACE["translation"],
                                                           rotation=turn((0, 1, 0), 45)),
         wrong=plain, options=AT_ONE)
def _():
    return animated("rotation", [turn((0, 1, 0), 0), turn((0, 1, 0), 90)])


@variant("an animation: scale", twin=lambda: moved_box(scale=[1, 1.5, 1], **PLACE), wrong=plain, options=AT_ONE)
def _():
    return animated("scale", [[1, 1, 1], [1, 2, 1]])


@variant("an animation: weights", twin=stretched, wrong=plain, options=AT_ONE)
def _():
    return animated("weights", [0, 0, 1, 0], make=lambda: morphed(lambda gltf: None))


@variant("an animation of a light", twin=lambda: moved_lamp(), wrong=plain, options=AT_ONE)
def _():
    return animated("translation", [[1.5, 1.5, 1.5], [1.5, 1.5, -1.5]], node="lamp")


def moved_lamp():
    gltf = plain()
    gltf.node("lamp")["translation"] = [1.5, 1.5, 0]
    return gltf


@variant("KHR_animation_pointer", told="KHR_animation_pointer", options=AT_ONE)
def _():
    gltf = animated("translation", [[1, 1, 1, 1], [0, 0, 1, 1]])
    channel = gltf.json["animations"][0]["channels"][0]
    channel["target"] = {"path": "pointer"}
    gltf.extension("KHR_animation_pointer", channel["target"],
                   {"pointer": "/materials/1/pbrMetallicRoughness/baseColorFactor"})
    return gltf


@variant("a skin without inverse bind matrices", wrong=no_box)
def _():
    gltf = skinned()
    del gltf.json["skins"][0]["inverseBindMatrices"]
    gltf.node("joint 0")["translation"] = PLACE["translation"]
    return gltf


@variant("a joint below a scaled node", wrong=lambda: no_scale())
def _():
    gltf = skinned()
    del gltf.json["skins"][0]["inverseBindMatrices"]
    gltf.node("joint 0")["translation"] = [2 * c for c in PLACE["translation"]]
    gltf.node("armature")["scale"] = [0.5] * 3
    doubled = [[2 * c for c in p] for p in box_mesh()[0]]
    gltf.box["attributes"]["POSITION"] = gltf.accessor(doubled)
    return gltf


@variant("a morphed skin", twin=lambda: deformed_box(stretch), wrong=plain, tolerance=1e-3)
def _():
    gltf, offsets = skinned(), [[b - a for a, b in zip(p, stretch(p))] for p in box_mesh()[0]]
    gltf.box["targets"] = [{"POSITION": gltf.accessor(offsets)}]
    gltf.node("box")["weights"] = [1]
    return gltf


@variant("an animated skin", twin=raised, wrong=plain, options=AT_ONE)
def _():
    up = [[x, y + 1, z] for x, y, z in PATH]
    return animated("translation", up, node="joint 0", make=skinned)


@variant("an animation by its name", twin=raised, wrong=plain, options=(*AT_ONE, "--animation", "up"))
def _():
    gltf = animated("translation", [PLACE["translation"]] * 2)
    still = gltf.json["animations"]
    moves = animated("translation", PATH, make=lambda: gltf).json["animations"]
    gltf.json["animations"] = [{**still[0], "name": "still"}, {**moves[0], "name": "up"}]
    return gltf


@variant("an animation before its first key", twin=raised, wrong=plain, options=AT_ONE)
def _():
    return animated("translation", [RAISED["translation"], [9, 9, 9]], times=(3, 4))


@variant("an animation with rotations of 16 bits", wrong=lambda: moved_box(translation=PLACE["translation"]),
         twin=lambda: moved_box(translation=PLACE["translation"], rotation=turn((0, 1, 0), 45)),
         tolerance=2e-3, options=AT_ONE)
def _():
    gltf = animated("rotation", [turn((0, 1, 0), 0), turn((0, 1, 0), 90)])
    steps = [[round(32767 * c) for c in turn((0, 1, 0), a)] for a in (0, 90)]
    gltf.json["animations"][0]["samplers"][0]["output"] = gltf.accessor(steps, SHORT, normalized=True)
    return gltf


@variant("an animation of a node with a matrix", refused="matrix", options=AT_ONE)
def _():
    return animated("translation", PATH, make=lambda: moved_box(matrix(**PLACE)))


@variant("a hidden node by an animation", told="KHR_animation_pointer", options=AT_ONE)
def _():
    gltf = animated("translation", [1, 0])
    target = gltf.json["animations"][0]["channels"][0]["target"] = {"path": "pointer"}
    gltf.extension("KHR_node_visibility", gltf.node("box"), {"visible": True})
    gltf.extension("KHR_animation_pointer", target, {"pointer": "/nodes/1/extensions/KHR_node_visibility/visible"})
    return gltf


@variant("an animation of an unknown path", told="color", options=AT_ONE)
def _():
    return animated("color", [[1, 1, 1], [0, 0, 1]])


@variant("a second animation", told="animation", twin=raised, options=AT_ONE)
def _():
    gltf = animated("translation", PATH)
    first = gltf.json["animations"]
    second = animated("scale", [[1, 1, 1], [1, 2, 1]], make=lambda: gltf).json["animations"]
    gltf.json["animations"] = first + second
    return gltf


@variant("a joint outside of the scene", refused="not in the scene")
def _():
    gltf = skinned()
    gltf.json["scenes"][0]["nodes"].remove(gltf.index("armature"))
    return gltf


@variant("a mesh below a joint", wrong=no_box)
def _():
    gltf = skinned()
    node = gltf.node("box")
    gltf.json["scenes"][0]["nodes"].remove(1)
    gltf.node("joint 1")["children"] = [gltf.json["nodes"].index(node)]
    return gltf


# Lights and cameras
def lit(**light):
    gltf = plain()
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"][1].update(light)
    return gltf


@variant("a light's defaults", twin=lambda: lit(intensity=1, color=[1, 1, 1]), wrong=plain)
def _():
    gltf = plain()
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"][1] = {"type": "point"}
    return gltf


@variant("a light in a scaled node", wrong=lambda: lit(intensity=16))
def _():
    gltf = plain()
    gltf.node("lamp")["scale"] = [2, 2, 2]
    return gltf


def high_lamp(**light):
    """The lamp high above the room, in which all is below it."""
    gltf = lit(intensity=40, **light)
    gltf.node("lamp")["translation"] = [0.5, 6, 0.5]
    return gltf


def spot(rotation, **cone):
    gltf = high_lamp(type="spot", spot=cone)
    gltf.node("lamp")["rotation"] = rotation
    return gltf


DOWN, UP, WIDE = turn((1, 0, 0), -90), turn((1, 0, 0), 90), {"innerConeAngle": 1.4, "outerConeAngle": 1.5}


@variant("a spot light that shines on all", twin=high_lamp, wrong=no_lamp, tolerance=1e-3)
def _():
    return spot(DOWN, **WIDE)


@variant("a spot light that looks away", twin=lambda: lit(intensity=1e-9), wrong=high_lamp)
def _():
    return spot(UP, **WIDE)


@variant("a spot light with its own cone", twin=lambda: spot(DOWN, innerConeAngle=0, outerConeAngle=math.pi / 4),
         wrong=high_lamp)
def _():
    return spot(DOWN)


@variant("a light with a range", twin=lambda: lit(intensity=1e-9), wrong=plain)
def _():
    return lit(range=0.1)


@variant("a light of an unknown type", told="type")
def _():
    return lit(type="area")


@variant("a profile of a light", told="EXT_lights_ies")
def _():
    gltf = plain()
    gltf.json["extensions"]["EXT_lights_ies"] = {"lights": [{"uri": "lamp.ies"}]}
    gltf.extension("EXT_lights_ies", gltf.node("lamp"), {"light": 0})
    return gltf


@variant("an image-based light", told="EXT_lights_image_based", or_read=True)
def _():
    gltf = plain()
    image = gltf.add("images", {"bufferView": gltf.view(flat_png()), "mimeType": "image/png"})
    gltf.json["extensions"]["EXT_lights_image_based"] = {"lights": [{
        "irradianceCoefficients": [[0.5, 0.5, 0.5]] + [[0, 0, 0]] * 8, "specularImageSize": 8,
        "specularImages": [[image] * 6]}]}
    gltf.extension("EXT_lights_image_based", gltf.json["scenes"][0], {"light": 0})
    return gltf


@variant("an area light of EXT_lights_area", told="EXT_lights_area", or_read=True)
def _():
    gltf = plain()
    gltf.json["extensions"]["EXT_lights_area"] = {"lights": [{"type": "rect", "intensity": 5, "size": 1}]}
    gltf.extension("EXT_lights_area", gltf.node("lamp"), {"light": 0})
    return gltf


@variant("a perspective camera")
def _():
    gltf = plain()
    gltf.add("cameras", {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}})
    gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "camera", "camera": 0}))
    return gltf


@variant("an orthographic camera", told="camera", or_read=True)
def _():
    gltf = plain()
    gltf.add("cameras", {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2, "znear": 0.1, "zfar": 10}})
    gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "camera", "camera": 0}))
    return gltf


@variant("a light that no node has", twin=no_lamp, wrong=plain)
def _():
    gltf = plain()
    gltf.node("lamp").pop("extensions")
    return gltf


@variant("a spot light with its cones swapped", refused="cone")
def _():
    return spot(DOWN, innerConeAngle=1, outerConeAngle=0.5)


# Extensions and extras
def unknown(required):
    gltf = plain()
    gltf.extension("EXT_of_the_future", gltf.paint, {"glow": 5}, required)
    return gltf


@variant("an unknown extension", told="EXT_of_the_future")
def _():
    return unknown(False)


@variant("an unknown extension, required", refused="EXT_of_the_future")
def _():
    return unknown(True)


@variant("KHR_xmp_json_ld", told="KHR_xmp_json_ld")
def _():
    gltf = plain()
    gltf.json["extensions"]["KHR_xmp_json_ld"] = {"packets": [{"dc:title": "box"}]}
    gltf.extension("KHR_xmp_json_ld", gltf.json["asset"], {"packet": 0})
    return gltf


@variants({"contributes_gi": ("box", "contributes_gi"), "contributeGI": ("box", "contributeGI"),
           "fall-off": ("lamp", "fall-off")}, "misspelt extras: {}", told="did you mean")
def _(extras):
    node, name = extras
    gltf = plain()
    gltf.node(node)["extras"] = {name: False}
    return gltf


@variant("extras in a wrong place", told="move it")
def _():
    gltf = plain()
    gltf.paint["extras"] = {"contribute_gi": False}
    return gltf


@variant("extras of another program", told="other extras")
def _():
    gltf = plain()
    gltf.node("box")["extras"] = {"blender_id": 7}
    return gltf


@variant("a member that glTF does not have", told="baseColourFactor")
def _():
    gltf = plain()
    gltf.paint["pbrMetallicRoughness"]["baseColourFactor"] = [0, 0, 1, 1]
    return gltf


@variant("a member in the wrong object", told="emissiveFactor")
def _():
    gltf = plain()
    gltf.paint["pbrMetallicRoughness"]["emissiveFactor"] = [1, 1, 1]
    return gltf


@variant("extras beside `extras`", told="contribute_gi")
def _():
    gltf = plain()
    gltf.node("box")["contribute_gi"] = False
    return gltf


@variant("a factor beside `pbrMetallicRoughness`", told="move it to pbrMetallicRoughness")
def _():
    gltf = plain()
    gltf.paint["baseColorFactor"] = [0, 0, 1, 1]
    return gltf


@variant("an extension beside `extensions`", twin=glowing([1, 1, 1]), told="KHR_materials_emissive_strength")
def _():
    gltf = glowing([1, 1, 1])()
    gltf.paint["KHR_materials_emissive_strength"] = {"emissiveStrength": 9}
    gltf.extension("KHR_materials_emissive_strength")
    return gltf


@variant("a later minor version", wrong=no_box)
def _():
    gltf = plain()
    gltf.json["asset"]["version"] = "2.1"
    return gltf


@variant("a minimum version that is too new", refused="2.1")
def _():
    gltf = plain()
    gltf.json["asset"].update(version="2.1", minVersion="2.1")
    return gltf


@variant("shaders of WebGL", refused="gltf-pipeline")
def _():
    gltf = plain()
    gltf.extension("KHR_techniques_webgl", gltf.paint, {"technique": 0}, required=True)
    return gltf


@variant("glTF 1.0", refused="gltf-pipeline")
def _():
    gltf = plain()
    gltf.json["asset"]["version"] = "1.0"
    return gltf


def in_centimetres():
    gltf = plain()
    parent = gltf.add("nodes", {"name": "centimetres", "scale": [100, 100, 100],
                                "children": gltf.json["scenes"][0]["nodes"]})
    gltf.json["scenes"][0]["nodes"] = [parent]
    return gltf


@variant("centimetres", told="units of length")
def _():
    gltf = in_centimetres()
    second = gltf.add("nodes", {"name": "second", "mesh": 1, "translation": [2, 0.4, 0]})
    gltf.node("centimetres")["children"] = [*gltf.node("centimetres")["children"], second]
    return gltf


@variant("lights in lumens of watts", told="--light-unit watt")
def _():
    gltf = glowing([1, 1, 1])()
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 3 * 683
    return gltf


@variant("lights in watts", options=("--light-unit", "watt"), wrong=lambda: lit(intensity=4 * 683))
def _():
    gltf = plain()
    for light in gltf.json["extensions"]["KHR_lights_punctual"]["lights"]:
        light["intensity"] *= 683
    return gltf


@variant("a lower-case attribute", told="position")
def _():
    gltf = plain()
    gltf.box["attributes"]["color_0"] = gltf.accessor([[0, 0, 1]] * 24)
    gltf.box["attributes"]["position"] = gltf.box["attributes"]["POSITION"]
    return gltf


@variant("COLOR without a number", told="COLOR")
def _():
    gltf = plain()
    gltf.box["attributes"]["COLOR"] = gltf.accessor([[0, 0, 1]] * 24)
    return gltf


@variant("extensions that the file does not declare", wrong=no_lamp)
def _():
    gltf = plain()
    del gltf.json["extensionsUsed"]
    return gltf


@variant("two materials of one name")
def _():
    gltf = plain()
    gltf.paint["name"] = "plaster"
    return gltf


# Containers
def text(document):
    return json.dumps(document).encode()


def data_uri(data, mime="application/octet-stream"):
    return f"data:{mime};base64," + base64.b64encode(data).decode()


def external(uri, file=None, make=plain):
    gltf = make()
    gltf.json["buffers"] = [{"byteLength": len(gltf.binary), "uri": uri}]
    return {"scene.gltf": text(gltf.json), **({file: bytes(gltf.binary)} if file else {})}


@variant(".gltf with an external buffer")
def _():
    return external("scene.bin", "scene.bin")


@variant("a buffer in a folder")
def _():
    return external("data/scene.bin", "data/scene.bin")


@variant("a percent-encoded URI")
def _():
    return external("my%20b%C3%BCffer%23.bin", "my büffer#.bin")


@variant("a URI with Unicode")
def _():
    return external("my büffer.bin", "my büffer.bin")


@variant("a missing buffer", refused="gone.bin")
def _():
    return external("gone.bin")


@variants({"octet-stream": "application/octet-stream", "gltf-buffer": "application/gltf-buffer"},
          "a data URI: {}")
def _(mime):
    gltf = plain()
    return external(data_uri(bytes(gltf.binary), mime))


@variant("a buffer longer than said")
def _():
    files = external("scene.bin", "scene.bin")
    return {**files, "scene.bin": files["scene.bin"] + b"more"}


@variant("a buffer shorter than said", refused="scene.bin")
def _():
    files = external("scene.bin", "scene.bin")
    return {**files, "scene.bin": files["scene.bin"][:-40]}


@variant("an image in a file", wrong=white_box)
def _():
    gltf = textured(flat_png())
    gltf.json["images"] = [{"uri": "paint%20and%20more.png"}]
    return {"scene.glb": gltf.glb(), "paint and more.png": flat_png()}


@variant("an image in a data URI", wrong=white_box)
def _():
    gltf = textured(flat_png())
    gltf.json["images"] = [{"uri": data_uri(flat_png(), "image/png")}]
    return gltf


@variant("a missing image", refused="gone.png")
def _():
    gltf = textured(flat_png())
    gltf.json["images"] = [{"uri": "gone.png"}]
    return gltf


@variant("a .glb with a second buffer")
def _():
    gltf = plain()
    positions = packed(box_mesh()[0])
    gltf.json["buffers"] = [{"byteLength": len(gltf.binary)}, {"byteLength": len(positions), "uri": "more.bin"}]
    view = gltf.add("bufferViews", {"buffer": 1, "byteLength": len(positions)})
    gltf.json["accessors"][gltf.box["attributes"]["POSITION"]]["bufferView"] = view
    return {"scene.glb": gltf.glb(), "more.bin": positions}


@variant("a .glb with a chunk of another kind")
def _():
    gltf = plain()
    document = text(gltf.document())
    return {"scene.glb": glb((b"JSON", document + b" " * (-len(document) % 4)),
                             (b"BIN\0", bytes(gltf.binary) + bytes(-len(gltf.binary) % 4)), (b"MORE", bytes(8)))}


@variant("JSON with a byte-order mark")
def _():
    files = external("scene.bin", "scene.bin")
    return {**files, "scene.gltf": b"\xef\xbb\xbf" + files["scene.gltf"]}


@variant("names in Unicode")
def _():
    gltf = plain()
    gltf.node("box")["name"] = "коробка 箱 📦"
    gltf.paint["name"] = "краска \"12\" \n"
    return {"сцена 箱.glb": gltf.glb()}


@variants({"http": "https://example.org/scene.bin", "file": "file:///tmp/scene.bin", "an absolute path": "/tmp/a.bin",
           "a path upwards": "../scene.bin"}, "a URI of {}", refused="below the scene's folder")
def _(uri):
    return external(uri)


@variant("a data URI without base64", refused="data URI")
def _():
    return external("data:application/octet-stream," + "%00" * 1020)


@variant("a buffer without a URI in a .gltf", refused="has no uri")
def _():
    gltf = plain()
    gltf.json["buffers"] = [{"byteLength": len(gltf.binary)}]
    return {"scene.gltf": text(gltf.json)}


@variant("a cut .glb", refused="bytes")
def _():
    return {"scene.glb": plain().glb()[:-100]}


@variant("a number of the wrong type", refused="is not")
def _():
    gltf = plain()
    gltf.paint["pbrMetallicRoughness"]["metallicFactor"] = "0"
    return gltf


@variant("rotations that are opposite numbers", wrong=lambda: moved_box(translation=PLACE["translation"]),
         twin=lambda: moved_box(translation=PLACE["translation"], rotation=turn((0, 1, 0), 45)), options=AT_ONE)
def _():  # a quaternion and its negative are the same rotation; the short way counts
    return animated("rotation", [turn((0, 1, 0), 0), [-c for c in turn((0, 1, 0), 90)]])


@variant("an animation: CUBICSPLINE rotation", wrong=plain, options=AT_ONE,
         twin=lambda: moved_box(translation=PLACE["translation"], rotation=turn((0, 1, 0), 45)))
def _():
    still = [0, 0, 0, 0]
    return animated("rotation", [still, turn((0, 1, 0), 0), still, still, turn((0, 1, 0), 90), still],
                    mode="CUBICSPLINE")


@variant("an animation: CUBICSPLINE weights", twin=stretched, wrong=plain, options=AT_ONE)
def _():  # of each key: in-tangents of all targets, values, out-tangents
    return animated("weights", [0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0], mode="CUBICSPLINE",
                    make=lambda: morphed(lambda gltf: None))


@variant("an animation: tangents of CUBICSPLINE", twin=lambda: moved_box(**{**PLACE, "translation": [0.3, 2.4, -0.2]}),
         wrong=plain, options=AT_ONE)
def _():  # at the middle: (from + to) / 2 + seconds / 8 (out-tangent of from - in-tangent of to)
    still, rise = [0, 0, 0], [0, 1.6, 0]
    return animated("translation", [still, PATH[0], rise, still, PATH[1], still], mode="CUBICSPLINE")


@variant("an animation of one key", twin=raised, wrong=plain, options=AT_ONE)
def _():
    return animated("translation", [RAISED["translation"]], times=(0.5,))


@variant("an animation after its last key", twin=raised, wrong=plain, options=("--time", "9"))
def _():
    return animated("translation", [PLACE["translation"], RAISED["translation"]])


@variant("a mesh with two skins", twin=lambda: two_skins_twin(), wrong=plain)
def _():
    gltf = skinned()
    x, y, z = SECOND["translation"]
    joint = gltf.add("nodes", {"name": "joint 2", **SECOND, "translation": [x, y + 1, z]})
    gltf.node("armature")["children"].append(joint)
    gltf.json["skins"].append({"joints": [joint, gltf.index("joint 1")],
                               "inverseBindMatrices": gltf.json["skins"][0]["inverseBindMatrices"]})
    gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "second", "mesh": 1, "skin": 1}))
    return gltf


def two_skins_twin():
    gltf = plain()
    gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "second", "mesh": 1, **SECOND}))
    return gltf


@variant("a sun in a mirrored node", wrong=lambda: turned_sun())
def _():
    gltf = plain()
    gltf.node("sun")["scale"] = [-1, 1, 3]
    return gltf


def turned_sun():
    gltf = plain()
    gltf.node("sun")["rotation"] = turn((1, 0, 0), -90)
    return gltf


@variant("instances of a node with a skin", told="skin")
def _():
    gltf = skinned()
    gltf.extension("EXT_mesh_gpu_instancing", gltf.node("box"), {
        "attributes": {"TRANSLATION": gltf.accessor([[0, 0, 0], [1, 0, 0]])}})
    return gltf


@variant("instances of a morphed mesh", twin=stretched, wrong=plain)
def _():
    gltf = morphed(lambda g: g.json["meshes"][1].update(weights=[0.5, 0]))
    gltf.extension("EXT_mesh_gpu_instancing", gltf.node("box"), {
        "attributes": {"TRANSLATION": gltf.accessor([[0, 0, 0]])}}, required=True)
    return gltf
