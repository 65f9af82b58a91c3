# SPDX-License-Identifier: Apache-2.0
"""The light of Blender's lamps in glTF's members and Tetralight's extras.

Intensities are those that Cycles renders: a sun of strength S gives S to a surface that faces it, a point or spot of
P watts has P / 4π in each direction, and an area light of P watts has P / 4 along its axis, whatever its size.
"""
import math


def intensity_of(light):
    """Of KHR_lights_punctual, without its colour: irradiance of suns, else along the axis at a distance of 1 m."""
    strength = light.energy * 2.0 ** getattr(light, "exposure", 0.0) * _emission(light)[0]
    if light.type == "SUN":
        return strength
    return strength / (4 if light.type == "AREA" else 4 * math.pi)


def color_of(light):
    return [a * b for a, b in zip(light.color, _emission(light)[1])]


def _emission(light):
    """Strength and colour of the Emission node of a light; 1 and white without one."""
    if not (light.use_nodes and light.node_tree):
        return 1.0, (1.0, 1.0, 1.0)
    for node in light.node_tree.nodes:
        if node.type == "EMISSION" and node.outputs[0].is_linked:
            return node.inputs["Strength"].default_value, node.inputs["Color"].default_value[:3]
    return 1.0, (1.0, 1.0, 1.0)


def is_exported_whole(light):
    """False for a light whose nodes change it in ways that glTF does not have."""
    if not (light.use_nodes and light.node_tree):
        return True
    linked = [node for node in light.node_tree.nodes if any(socket.is_linked for socket in node.inputs)]
    return all(node.type == "OUTPUT_LIGHT" for node in linked)


def size_extras(light):
    """Extras that give a lamp or a sun the size that it has in Blender."""
    if light.type == "SUN":
        return {"angle": min(math.degrees(light.angle), 180.0)} if light.angle > 0 else {}
    return {"radius": light.shadow_soft_size} if light.shadow_soft_size > 0 else {}


def area_extras(light, scale):
    """Extras that make a point light an area light. `scale` is that of the object along its X and Y axes."""
    is_round = light.shape in ("DISK", "ELLIPSE")
    width = light.size * abs(scale[0])
    height = (light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size) * abs(scale[1])
    if not is_round:
        return {"shape": "rectangle", "width": width, "height": height}
    if is_circle(width, height):
        return {"shape": "disc", "radius": width / 2}
    side = math.sqrt(math.pi) / 2  # a rectangle with the area of the ellipse
    return {"shape": "rectangle", "width": width * side, "height": height * side}


def is_circle(width, height):
    return abs(width - height) <= 1e-4 * max(width, height)

