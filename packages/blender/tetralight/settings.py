# SPDX-License-Identifier: Apache-2.0
"""Settings of bakes, which a .blend file keeps with its scene."""
from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from .baking import BakeSettings

KEY = "tetralight"  # of the settings in the custom properties of a scene


class TetralightSettings(bpy.types.PropertyGroup):
    output: StringProperty(
        name="Output", description="Probe volume to write. Empty: beside the .blend file, with its name",
        subtype="FILE_PATH")
    quality: EnumProperty(
        name="Quality",
        items=[
            ("ERROR", "Target Error", "Sample each probe until its error is small enough"),
            ("SAMPLES", "Samples", "The same number of samples for each probe, for previews"),
        ],
    )
    target_error: FloatProperty(
        name="Target Error", description="Relative standard error of the light of a probe, percent",
        subtype="PERCENTAGE", default=0.5, min=0.01, max=100.0)
    samples: IntProperty(name="Samples", description="Samples per probe", default=256, min=1, max=16777216)
    mixed_lighting: EnumProperty(
        name="Mixed Lights",
        items=[
            ("indirect", "Indirect", "Shadows of mixed lights are computed at run time"),
            ("shadowmask", "Shadow Mask", "Probes also hold the occlusion of up to four mixed lights"),
            ("subtractive", "Subtractive", "As Shadow Mask, but moving objects get the brightest sun only"),
        ],
    )
    places_probes: BoolProperty(
        name="Place Probes", description="Fill the scene with probes, in addition to the probe groups that it has")
    spacing: FloatProperty(
        name="Spacing", description="Metres between the probes that are placed", default=2.0, min=0.01, max=10000.0)
    soft_shadows: BoolProperty(
        name="Soft Shadows", description="Export the radius of lamps and the angle of suns", default=True)
    service_name: StringProperty(
        name="Name", description="Name of the scene and of its volume in the service. Empty: they have no name")
    shows_probes: BoolProperty(name="Show Probes", description="Show the probes after the bake", default=True)
    ball_radius: FloatProperty(
        name="Ball Radius", description="Radius of the balls that show probes, metres", default=0.1, min=1e-4,
        max=1000.0)
    exposure: FloatProperty(
        name="Exposure", description="Stops by which the colours of the balls are brighter than the light", min=-20.0,
        max=20.0)


def bake_settings(scene):
    settings = scene.tetralight
    order = {"mixed_lighting": settings.mixed_lighting}
    if settings.quality == "ERROR":
        order["target_error"] = settings.target_error / 100
    else:
        order["samples"] = settings.samples
    spacing = settings.spacing if settings.places_probes else None
    return BakeSettings(order=order, grid_spacing=spacing, name=settings.service_name.strip())


def output_path(scene):
    """Where the probe volume is written; None if that is not known."""
    chosen = scene.tetralight.output
    if not chosen and not bpy.data.filepath:
        return None
    if chosen.startswith("//") and not bpy.data.filepath:
        return None
    if not chosen:
        return Path(bpy.data.filepath).with_suffix(".probes")
    return Path(bpy.path.ensure_ext(bpy.path.abspath(chosen), ".probes"))


def output_is_folder(scene):
    """Whether the chosen output names a folder instead of a file."""
    chosen = bpy.path.abspath(scene.tetralight.output)
    return chosen.endswith(("/", "\\")) or (chosen != "" and Path(chosen).is_dir())


def register():
    bpy.utils.register_class(TetralightSettings)
    bpy.types.Scene.tetralight = PointerProperty(type=TetralightSettings)


def unregister():
    del bpy.types.Scene.tetralight
    bpy.utils.unregister_class(TetralightSettings)
