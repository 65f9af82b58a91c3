# SPDX-License-Identifier: Apache-2.0
"""The tab Tetralight in the sidebar of 3D views, and a panel of materials."""
import bpy

from . import operators
from .marks import PREFIX, stored
from .preferences import preferences


def show_marks(layout, owner, *names):
    """A row for each mark; those that may be absent have a box to tick."""
    for name in names:
        shown, use = PREFIX + name, _use_of(name)
        if not hasattr(owner, use):
            layout.prop(owner, shown)
            continue
        row = layout.row(heading=owner.bl_rna.properties[use].name)
        row.prop(owner, use, text="")
        value = row.row()
        value.active = getattr(owner, use)
        value.prop(owner, shown, text="")


def _use_of(name):
    """The property that says whether a number is there: `adjustment_use_spacing` of `adjustment_spacing`."""
    for prefix in ("adjustment_", "reflection_"):
        if name.startswith(prefix):
            return f"{PREFIX}{prefix}use_{name[len(prefix):]}"
    return f"{PREFIX}use_{name}"


class Tab:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Tetralight"


class TETRALIGHT_PT_bake(Tab, bpy.types.Panel):
    bl_label = "Bake"

    def draw(self, context):
        layout, settings = self.layout, context.scene.tetralight
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(settings, "output")
        layout.prop(settings, "quality")
        layout.prop(settings, "target_error" if settings.quality == "ERROR" else "samples")
        layout.prop(settings, "mixed_lighting")
        layout.prop(settings, "soft_shadows")
        row = layout.row(heading="Place Probes")
        row.prop(settings, "places_probes", text="")
        spacing = row.row()
        spacing.active = settings.places_probes
        spacing.prop(settings, "spacing", text="")
        if preferences(context).bake_with == "SERVICE":
            layout.prop(settings, "service_name")
        if operators.running:
            layout.label(text=operators.progress_text(operators.running.bake.progress))
            layout.operator("tetralight.cancel_bake", icon="CANCEL")
        else:
            layout.operator("tetralight.bake", icon="OUTLINER_OB_LIGHTPROBE")
        layout.operator("tetralight.export", icon="EXPORT")


class TETRALIGHT_PT_shown(Tab, bpy.types.Panel):
    bl_label = "Probes"

    def draw(self, context):
        layout, settings = self.layout, context.scene.tetralight
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(settings, "shows_probes")
        layout.prop(settings, "ball_radius")
        layout.prop(settings, "exposure")
        layout.operator("tetralight.show_probes", icon="HIDE_OFF")
        layout.operator("tetralight.hide_probes", icon="HIDE_ON")


class TETRALIGHT_PT_add(Tab, bpy.types.Panel):
    bl_label = "Add"

    def draw(self, context):
        self.layout.operator("tetralight.add_probe_group", icon="OUTLINER_OB_POINTCLOUD")
        for kind, (label, *_) in operators.HELPERS.items():
            self.layout.operator("tetralight.add_helper", text=label, icon="EMPTY_DATA").kind = kind


class TETRALIGHT_PT_object(Tab, bpy.types.Panel):
    bl_label = "Object"

    @classmethod
    def poll(cls, context):
        return context.object is not None

    def draw(self, context):
        layout, thing = self.layout, context.object
        layout.use_property_split, layout.use_property_decorate = True, False
        if stored(thing, ("probe_adjustment",)) is not None:
            show_marks(layout, thing, *(f"adjustment_{name}" for name in (
                "shape", "forbid", "spacing", "validity", "intensity", "rendering_layers")))
        elif stored(thing, ("reflection_probe",)) is not None:
            show_marks(layout, thing, "reflection_blend_distance", "reflection_importance", "reflection_near")
        elif stored(thing, ("portal",)) is not None:
            layout.label(text="A window or door across the local Y axis")
        elif thing.type == "LIGHT":
            show_marks(layout, thing.data, "mode", "indirect_multiplier")
            if thing.data.type in ("POINT", "SPOT"):
                show_marks(layout, thing.data, "falloff")
        else:
            self.draw_thing(layout, thing)

    @staticmethod
    def draw_thing(layout, thing):
        show_marks(layout, thing, "light_probe_group")
        if thing.tetralight_light_probe_group:
            show_marks(layout, thing, "dering", "rendering_layers")
            return
        show_marks(layout, thing, "contribute_gi")
        if thing.tetralight_contribute_gi == "0":
            show_marks(layout, thing, "light_probes")
            layout.prop_search(thing, PREFIX + "probe_anchor", bpy.data, "objects")
        else:
            show_marks(layout, thing, "receive_gi", "lightmap_scale", "stitch_seams")
        show_marks(layout, thing, "walkable", "in_reflections")


class TETRALIGHT_PT_material(bpy.types.Panel):
    bl_label = "Tetralight"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.material is not None

    def draw(self, context):
        self.layout.use_property_split = True
        show_marks(self.layout, context.material, "bake_emission")


# In the order of the tab.
CLASSES = (TETRALIGHT_PT_bake, TETRALIGHT_PT_object, TETRALIGHT_PT_shown, TETRALIGHT_PT_add, TETRALIGHT_PT_material)


def register():
    for panel in CLASSES:
        bpy.utils.register_class(panel)


def unregister():
    for panel in reversed(CLASSES):
        bpy.utils.unregister_class(panel)
