# SPDX-License-Identifier: Apache-2.0
"""Custom properties that Tetralight reads (docs/scenes.md), as properties that panels can show.

Each is registered with functions that read and write the custom property, which is what Blender saves and its glTF
exporter writes as `extras`. A custom property that is absent has the default of Tetralight.
"""
import bpy
from bpy.props import BoolProperty, BoolVectorProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

PREFIX = "tetralight_"
LAYER_COUNT = 32
LARGEST = 1e6


def stored(owner, path):
    """The custom property of an ID at a path such as ("probe_adjustment", "shape"); None if it is absent."""
    value = owner
    for name in path:
        if not hasattr(value, "keys") or name not in value.keys():
            return None
        value = value[name]
    return value


def store(owner, path, value):
    """Sets the custom property, or removes it if `value` is None."""
    *parents, name = path
    for parent in parents:
        if not hasattr(stored(owner, (parent,)), "keys"):
            owner[parent] = {}
        owner = owner[parent]
    if value is not None:
        owner[name] = value
    elif name in owner.keys():
        del owner[name]


def choice(path, label, description, *items):
    """One of several values. An item is (value, label, description); the value None stands for absence."""
    values = [value for value, _, _ in items]

    def read(owner):
        value = stored(owner, path)
        return values.index(value) if value in values else 0

    def write(owner, index):
        store(owner, path, values[index])

    shown = [("DEFAULT" if value is None else str(value).upper(), *texts) for value, *texts in items]
    shown = [(*item, "NONE", i) for i, item in enumerate(shown)]
    return {path[-1]: EnumProperty(name=label, description=description, items=shown, get=read, set=write)}


def switch(path, label, description, value):
    """On: the custom property has this value. Off: it is absent."""

    def read(owner):
        found = stored(owner, path)
        return found is not None and found != 0

    def write(owner, is_on):
        store(owner, path, value if is_on else None)

    return {path[-1]: BoolProperty(name=label, description=description, get=read, set=write)}


def number(path, label, description, default, low=0.0, high=LARGEST, kind=FloatProperty):
    """A number that may be absent: a property for the number, and one, `use_NAME`, for its presence."""

    def read(owner):
        found = stored(owner, path)
        return found if isinstance(found, (int, float)) else default

    def is_present(owner):
        return stored(owner, path) is not None

    def write(owner, value):
        store(owner, path, value)

    def set_present(owner, is_on):
        store(owner, path, default if is_on else None)

    value = kind(name=label, description=description, min=low, max=high, get=read, set=write)
    about_use = f"{description}. Off: Tetralight's default"
    use = BoolProperty(name=label, description=about_use, get=is_present, set=set_present)
    return {path[-1]: value, f"use_{path[-1]}": use}


def text(path, label, description):
    """A text; absent if it is empty."""

    def read(owner):
        return str(stored(owner, path) or "")

    def write(owner, value):
        store(owner, path, value or None)

    return {path[-1]: StringProperty(name=label, description=description, get=read, set=write)}


def layers(path, label, description):
    """A list of rendering layers; absent if all are on, or none is."""

    def read(owner):
        found = stored(owner, path)
        return [found is None or i in list(found) for i in range(LAYER_COUNT)]

    def write(owner, is_on):
        chosen = [i for i, is_chosen in enumerate(is_on) if is_chosen]
        store(owner, path, chosen if 0 < len(chosen) < LAYER_COUNT else None)

    shape = {"size": LAYER_COUNT, "subtype": "LAYER"}
    return {path[-1]: BoolVectorProperty(name=label, description=description, get=read, set=write, **shape)}


def prefixed(prefix, properties):
    return {prefix + name: shown for name, shown in properties.items()}


INHERITED = (None, "Inherited", "As the parent has it; without one, the first of the other choices")

STATIC_OBJECT = {
    **choice(("contribute_gi",), "Role", "Whether the bake sees the object",
             INHERITED, (1, "Static", "It blocks and reflects light"),
             (0, "Moves", "Probes light it; the bake ignores it")),
    **choice(("receive_gi",), "Light From", "What lights the static object",
             INHERITED, ("lightmap", "Lightmaps", "Its texels in a lightmap"), ("probes", "Probes", "Probes alone")),
    **number(("lightmap_scale",), "Lightmap Scale",
             "Factor on the texels per metre of the lightmap; 0: no lightmap", 1.0),
    **choice(("stitch_seams",), "Seams", "Seams between the charts of the object's lightmap",
             INHERITED, (1, "Stitched", "Both sides of a seam get the same light"),
             (0, "As Baked", "Left as they are")),
    **choice(("walkable",), "Walkable", "Whether the generator places probes above the object",
             (None, "Inherited", "As the parent has it; without one, No"), (1, "Yes", "Things move on it"),
             (0, "No", "Nothing moves on it")),
    **choice(("in_reflections",), "Reflections", "Whether reflection probes show the object",
             INHERITED, (1, "Shown", "Reflection probes show it"), (0, "Hidden", "It only lights what they show")),
}

MOVING_OBJECT = {
    **choice(("light_probes",), "Probes", "How probes light the moving object",
             INHERITED, ("blend", "One Place", "By the light at its centre"),
             ("proxy_volume", "Proxy Volume", "By a grid of light around it, for large objects"),
             ("off", "Off", "By the ambient light of the volume")),
    **text(("probe_anchor",), "Anchor",
           "Name of the object at whose origin the light is taken; empty: the centre of the bounds"),
}

PROBE_GROUP = {
    **switch(("light_probe_group",), "Probe Group",
             "The loose vertices of the mesh, or else the children of the object, are probes", 1),
    **switch(("dering",), "Remove Ringing", "Remove negative irradiance from the probes of the group", 1),
    **layers(("rendering_layers",), "Rendering Layers", "The probes light objects on these layers only"),
}

ADJUSTMENT = prefixed("adjustment_", {
    **choice(("probe_adjustment", "shape"), "Shape", "Shape of the volume",
             ("box", "Box", "A box of 1 m, times the object's scale"),
             ("sphere", "Sphere", "A sphere with a radius of 1 m, times the object's scale")),
    **choice(("probe_adjustment", "forbid"), "Probes", "Whether there are probes in the volume",
             (None, "Unchanged", "As a larger volume has it"), (1, "Forbidden", "No probes"),
             (0, "Allowed", "Probes, inside a larger volume that forbids them")),
    **number(("probe_adjustment", "spacing"), "Spacing",
             "Metres between the probes that the generator places", 1.0, low=1e-3),
    **number(("probe_adjustment", "validity"), "Validity",
             "1: probes are valid; 0: they are inside geometry", 1.0, high=1.0),
    **number(("probe_adjustment", "intensity"), "Intensity", "Factor on the baked light of the probes", 1.0),
    **layers(("probe_adjustment", "rendering_layers"), "Rendering Layers", "Rendering layers of the probes"),
})

REFLECTION_PROBE = prefixed("reflection_", {
    **number(("reflection_probe", "blend_distance"), "Blend Distance",
             "Metres over which the probe fades out outside its box", 0.25),
    **number(("reflection_probe", "importance"), "Importance",
             "Probes of higher importance hide those of lower importance", 1, 1 - 2**31, 2**31 - 1, IntProperty),
    **number(("reflection_probe", "near"), "Near", "Surfaces nearer than this are not in the cube, metres", 0.0),
})

LIGHT = {
    **choice(("mode",), "Mode", "What probes hold of the light",
             (None, "Mixed", "Its bounces; direct light is added at run time"),
             ("baked", "Baked", "Its bounces and its direct light"), ("realtime", "Real Time", "Nothing")),
    **number(("indirect_multiplier",), "Indirect Multiplier", "Factor on the light's bounces only", 1.0),
    **choice(("falloff",), "Falloff", "Falloff over distance. All but the first need a Custom Distance",
             (None, "glTF", "Inverse square, to 0 at the custom distance"),
             ("inverse-square-range", "Inverse Square with Range", "As glTF, but smoother at its end"),
             ("linear", "Linear", "Linear, to 0 at the custom distance"),
             ("legacy", "Legacy", "1 / (1 + 25 x²) of the share x of the distance")),
}

MATERIAL = {
    **choice(("bake_emission",), "Emission", "Whether the bake includes the emission of the material",
             (None, "Baked", "Probes and lightmaps hold it"), ("none", "Not Baked", "It only glows")),
}

OBJECT = {**STATIC_OBJECT, **MOVING_OBJECT, **PROBE_GROUP, **ADJUSTMENT, **REFLECTION_PROBE}
OWNERS = ((bpy.types.Object, OBJECT), (bpy.types.Light, LIGHT), (bpy.types.Material, MATERIAL))


def register():
    for owner, properties in OWNERS:
        for name, shown in properties.items():
            setattr(owner, PREFIX + name, shown)


def unregister():
    for owner, properties in OWNERS:
        for name in properties:
            delattr(owner, PREFIX + name)
