# SPDX-License-Identifier: Apache-2.0
"""The sky that a world of Blender is: constant, or an equirectangular image."""
import math
from dataclasses import dataclass
from pathlib import Path

import bpy

SKY_FILES = (".hdr", ".exr")  # formats that Tetralight reads


@dataclass
class Sky:
    """A constant radiance, or an image with a factor and a rotation; black without both."""

    radiance: list | None = None
    image: bpy.types.Image | None = None
    intensity: float = 1.0
    rotation: float = 0.0  # degrees about the vertical axis, counter-clockwise seen from above
    problem: str = ""  # why the world is left out

    def order(self):
        """Settings of a bake, beside the image itself."""
        return {"sky_intensity": self.intensity, "sky_rotation": self.rotation} if self.image else {}


def sky_of(scene):
    """The scene's sky. Its custom property `sky`, which the exporter writes, takes precedence over its world."""
    world = scene.world
    if world is None or "sky" in scene.keys():
        return Sky()
    if not (world.use_nodes and world.node_tree):
        return Sky(radiance=list(world.color))
    outputs = [node for node in world.node_tree.nodes if node.type == "OUTPUT_WORLD" and node.is_active_output]
    background = _source(outputs[0].inputs["Surface"]) if outputs else None
    if background is None:
        return Sky()
    if background.type != "BACKGROUND" or background.inputs["Strength"].is_linked:
        return _left_out(world, "only a Background node with a fixed strength is exported")
    strength = max(background.inputs["Strength"].default_value, 0.0)
    source = _source(background.inputs["Color"])
    if source is None:
        color = background.inputs["Color"].default_value[:3]
        return Sky(radiance=[max(value, 0.0) * strength for value in color])
    return _image_sky(world, source, strength)


def write_sky(sky, folder):
    """The path of a file with the image, which is written into the folder if there is none.

    Raises ValueError if the image has no pixels.
    """
    image = sky.image
    path = Path(bpy.path.abspath(image.filepath, library=image.library))
    if path.suffix.lower() in SKY_FILES and path.is_file() and not image.packed_file and not image.is_dirty:
        return path
    if not image.has_data:
        len(image.pixels)  # loads it
    if not image.has_data or not image.is_float or image.channels != 4:
        raise ValueError(f'the image "{image.name}" of the world is not an .hdr or .exr file that can be read')
    path = Path(folder) / "sky.exr"
    # Not a picture but data, whose numbers Blender does not convert to sRGB.
    copy = bpy.data.images.new("sky", *image.size, float_buffer=True, is_data=True)
    try:
        copy.pixels.foreach_set(image.pixels[:])
        copy.file_format = "OPEN_EXR"
        copy.filepath_raw = str(path)
        copy.save()
    finally:
        bpy.data.images.remove(copy)
    return path


def _image_sky(world, node, strength):
    if node.type != "TEX_ENVIRONMENT" or node.image is None or node.projection != "EQUIRECTANGULAR":
        return _left_out(world, "its colour is neither constant nor an equirectangular Environment Texture")
    mapping = _source(node.inputs["Vector"])
    if mapping is None or mapping.type == "TEX_COORD":
        return Sky(image=node.image, intensity=strength)
    if mapping.type != "MAPPING" or not _only_turns(mapping):
        return _left_out(world, "the coordinates of its image are more than turned about Z")
    rotation = -math.degrees(mapping.inputs["Rotation"].default_value[2])
    return Sky(image=node.image, intensity=strength, rotation=math.fmod(rotation, 360))


def _only_turns(mapping):
    """True for a Mapping node that turns about Z, and does nothing else."""
    if any(socket.is_linked for socket in list(mapping.inputs)[1:]) or mapping.vector_type != "POINT":
        return False
    x, y, _ = mapping.inputs["Rotation"].default_value
    return (x, y) == (0, 0) and tuple(mapping.inputs["Location"].default_value) == (0, 0, 0) and (
        tuple(mapping.inputs["Scale"].default_value) == (1, 1, 1))


def _source(socket):
    return socket.links[0].from_node if socket.is_linked else None


def _left_out(world, reason):
    return Sky(problem=f'the world "{world.name}" is left out: {reason}')
