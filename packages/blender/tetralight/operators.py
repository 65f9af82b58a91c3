# SPDX-License-Identifier: Apache-2.0
"""What the buttons of the panels do."""
import time
from pathlib import Path

import bpy
from bpy.app.handlers import load_pre, persistent
from bpy.props import EnumProperty, FloatProperty, FloatVectorProperty, StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper
from bpy_extras.object_utils import AddObjectHelper, object_data_add

from .baking import BakeError
from .export import ExportError, write_scene
from .preferences import new_bake
from .probe_file import read_probes
from .service import ServiceError
from .settings import bake_settings, output_is_folder, output_path
from .show_probes import hide_probes, show_probes, shown_probes
from .world import sky_of, write_sky

SECONDS_BETWEEN_STEPS = 0.2
MOST_PROBES_OF_A_GROUP = 1000000


class RunningBake:
    """The bake in progress and the scene that it is for. Blender runs one at a time."""

    def __init__(self, bake, scene, output):
        self.bake = bake
        self.scene_name = scene.name
        self.output = output


running = None  # a RunningBake, or None


def start_bake(context):
    """Exports the scene and starts its bake. Returns warnings of the export."""
    global running
    if output_is_folder(context.scene):
        raise BakeError(f"the output {context.scene.tetralight.output} is a folder: name a file in it")
    output = output_path(context.scene)
    if output is None:
        raise BakeError("save the .blend file, or choose an output: there is no folder for the probe volume yet")
    if not output.parent.is_dir():
        raise BakeError(f"there is no folder {output.parent} for the probe volume")
    settings = bake_settings(context.scene)
    bake = new_bake(context, settings)
    try:
        warnings = write_scene(context, bake.scene)
        sky = sky_of(context.scene)
        if sky.image:
            settings.sky = write_sky(sky, bake.scene.parent)
            settings.order.update(sky.order())
    except BaseException:
        bake.close()
        raise
    bake.start()
    running = RunningBake(bake, context.scene, output)
    return warnings


def finish_bake():
    """Moves the result of the bake to its place, and shows it. Returns the number of probes and warnings."""
    global running
    finished, running = running, None
    bake = finished.bake
    try:
        if bake.error:
            raise BakeError(bake.error)
        probes = read_probes(bake.result)
        bake.move_result(finished.output)
    finally:
        bake.close()
    scene = bpy.data.scenes.get(finished.scene_name)
    if scene and scene.tetralight.shows_probes:
        show(scene, probes, finished.output)
    return len(probes), bake.warnings


def cancel_bake():
    global running
    if running:
        cancelled, running = running, None
        cancelled.bake.cancel()


@persistent
def cancel_before_loading(*_):
    """The scene of the bake is about to go."""
    cancel_bake()


def show(scene, probes, path):
    settings = scene.tetralight
    shown = show_probes(scene, probes, path.name, settings.ball_radius, settings.exposure)
    shown["volume"] = str(path)


class TETRALIGHT_OT_bake(bpy.types.Operator):
    bl_idname = "tetralight.bake"
    bl_label = "Bake Probes"
    bl_description = "Export the scene and bake its light into a probe volume. Esc cancels"
    bl_options = {"UNDO"}

    _timer = None
    _mine = None  # the RunningBake of this operator; the button may have ended it, and begun another one

    @classmethod
    def poll(cls, context):
        return running is None

    def execute(self, context):
        """From a script: waits until the bake is over."""
        if not self._start(context):
            return {"CANCELLED"}
        while not running.bake.is_over():
            time.sleep(SECONDS_BETWEEN_STEPS / 4)
        return self._finish()

    def invoke(self, context, event):
        """From the user interface, which does not wait."""
        if not self._start(context):
            return {"CANCELLED"}
        self._mine = running
        manager = context.window_manager
        manager.progress_begin(0, 100)
        self._timer = manager.event_timer_add(SECONDS_BETWEEN_STEPS, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        is_escape = event.type == "ESC" and event.value == "PRESS"
        if is_escape or running is not self._mine:
            self.cancel(context)
            self.report({"WARNING"}, "The bake was cancelled; no file was changed")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if running.bake.is_over():
            self._end_modal(context)
            return self._finish()
        self._show_progress(context)
        return {"PASS_THROUGH"}

    def cancel(self, context):
        """Blender calls it, too, when it ends or loads another file."""
        if running is self._mine:
            cancel_bake()
        self._end_modal(context)

    def _start(self, context):
        try:
            warnings = start_bake(context)
        except (BakeError, ExportError, ServiceError, OSError, ValueError) as error:
            self.report({"ERROR"}, str(error))
            return False
        self._warn(warnings)
        return True

    def _finish(self):
        try:
            count, warnings = finish_bake()
        except (BakeError, ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self._warn(warnings)
        self.report({"INFO"}, f"Baked {count} probes")
        return {"FINISHED"}

    def _warn(self, warnings):
        for warning in warnings:
            self.report({"WARNING"}, warning)

    def _show_progress(self, context):
        progress = self._mine.bake.progress
        context.window_manager.progress_update(round(100 * (progress.fraction or 0)))
        context.workspace.status_text_set(f"Tetralight: {progress_text(progress)}. Esc: cancel")
        redraw_sidebars(context)

    def _end_modal(self, context):
        if self._timer:
            context.window_manager.event_timer_remove(self._timer)
            context.window_manager.progress_end()
            context.workspace.status_text_set(None)
            self._timer = None
            redraw_sidebars(context)


def progress_text(progress):
    left = progress.seconds_left
    if left is None:
        return progress.text
    return f"{progress.text}, {left:.0f} s left" if left < 100 else f"{progress.text}, {left / 60:.0f} min left"


def redraw_sidebars(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


class TETRALIGHT_OT_cancel_bake(bpy.types.Operator):
    bl_idname = "tetralight.cancel_bake"
    bl_label = "Cancel"
    bl_description = "End the bake. No file changes"

    @classmethod
    def poll(cls, context):
        return running is not None

    def execute(self, context):
        cancel_bake()
        return {"FINISHED"}


class TETRALIGHT_OT_export(bpy.types.Operator, ExportHelper):
    bl_idname = "tetralight.export"
    bl_label = "Export for Tetralight"
    bl_description = "Write the scene as glTF with the units and marks that Tetralight reads"

    filename_ext = ".glb"
    filter_glob: StringProperty(default="*.glb", options={"HIDDEN"})

    def execute(self, context):
        if not self.filepath:
            self.report({"ERROR"}, "choose a file to write")
            return {"CANCELLED"}
        target = Path(bpy.path.ensure_ext(self.filepath, ".glb"))
        if not target.parent.is_dir():
            self.report({"ERROR"}, f"there is no folder {target.parent} for the scene")
            return {"CANCELLED"}
        beside = target.with_name(f".{target.stem}.new.glb")
        try:
            warnings = write_scene(context, beside)
            beside.replace(target)
            sky = sky_of(context.scene)
            if sky.image:
                options = f"--sky-intensity {sky.intensity:g} --sky-rotation {sky.rotation:g}"
                warnings.append(f'the file does not have the image "{sky.image.name}" of the world: '
                                f"give it to the command as --sky, with {options}")
        except (ExportError, OSError) as error:
            beside.unlink(missing_ok=True)
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for warning in warnings:
            self.report({"WARNING"}, warning)
        return {"FINISHED"}


class TETRALIGHT_OT_show_probes(bpy.types.Operator, ImportHelper):
    bl_idname = "tetralight.show_probes"
    bl_label = "Show Probes of a File"
    bl_description = "Show the probes of a .probes file as balls in the colour of their light"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".probes"
    filter_glob: StringProperty(default="*.probes", options={"HIDDEN"})

    def execute(self, context):
        path = Path(self.filepath)
        if not path.is_file():
            self.report({"ERROR"}, f"{path} is not a file" if self.filepath else "choose a .probes file")
            return {"CANCELLED"}
        try:
            show(context.scene, read_probes(path), path)
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class TETRALIGHT_OT_hide_probes(bpy.types.Operator):
    bl_idname = "tetralight.hide_probes"
    bl_label = "Remove Balls"
    bl_description = "Remove the balls that show probes"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return shown_probes(context.scene) is not None

    def execute(self, context):
        hide_probes(context.scene)
        return {"FINISHED"}


class TETRALIGHT_OT_add_probe_group(bpy.types.Operator, AddObjectHelper):
    bl_idname = "tetralight.add_probe_group"
    bl_label = "Add Probe Group"
    bl_description = "Add a mesh of loose vertices, each of which is a probe"
    bl_options = {"REGISTER", "UNDO"}

    size: FloatVectorProperty(name="Size", subtype="XYZ_LENGTH", default=(4, 4, 2), min=0)
    spacing: FloatProperty(name="Spacing", description="Metres between probes", default=1, min=0.01)

    def execute(self, context):
        counts = [int(side / self.spacing + 1e-4) + 1 for side in self.size]
        total = counts[0] * counts[1] * counts[2]
        if total > MOST_PROBES_OF_A_GROUP:
            self.report({"ERROR"}, f"{total} probes are more than {MOST_PROBES_OF_A_GROUP}: choose a wider spacing")
            return {"CANCELLED"}
        axes = [[self.spacing * (i - (count - 1) / 2) for i in range(count)] for count in counts]
        mesh = bpy.data.meshes.new("Probes")
        mesh.from_pydata([(x, y, z) for x in axes[0] for y in axes[1] for z in axes[2]], [], [])
        group = object_data_add(context, mesh, operator=self, name="Probes")
        group["light_probe_group"] = 1
        return {"FINISHED"}


# Custom properties, and the shape of the empty. An empty of 0.5 m shows a cube with sides of 1 m. An adjustment volume
# that adjusts nothing is an error: new ones forbid probes.
HELPERS = {
    "BOX": ("Adjustment Box", {"probe_adjustment": {"shape": "box", "forbid": 1}}, "CUBE", 0.5, (2, 2, 2)),
    "SPHERE": ("Adjustment Sphere", {"probe_adjustment": {"shape": "sphere", "forbid": 1}}, "SPHERE", 1.0, (1, 1, 1)),
    "REFLECTION": ("Reflection Probe", {"reflection_probe": {"size": [1.0, 1.0, 1.0]}}, "CUBE", 0.5, (10, 10, 10)),
    "PORTAL": ("Portal", {"portal": [1.0, 1.0]}, "CUBE", 0.5, (1, 0.02, 2)),
}


class TETRALIGHT_OT_add_helper(bpy.types.Operator, AddObjectHelper):
    bl_idname = "tetralight.add_helper"
    bl_label = "Add Helper"
    bl_description = "Add an empty that changes how Tetralight bakes. Its scale is its size"
    bl_options = {"REGISTER", "UNDO"}

    kind: EnumProperty(name="Kind", items=[(name, helper[0], "") for name, helper in HELPERS.items()])

    def execute(self, context):
        name, properties, shape, display_size, scale = HELPERS[self.kind]
        helper = object_data_add(context, None, operator=self, name=name)
        helper.empty_display_type = shape
        helper.empty_display_size = display_size
        helper.scale = scale
        for key, value in properties.items():
            helper[key] = value
        return {"FINISHED"}


CLASSES = (
    TETRALIGHT_OT_bake,
    TETRALIGHT_OT_cancel_bake,
    TETRALIGHT_OT_export,
    TETRALIGHT_OT_show_probes,
    TETRALIGHT_OT_hide_probes,
    TETRALIGHT_OT_add_probe_group,
    TETRALIGHT_OT_add_helper,
)


def register():
    for operator in CLASSES:
        bpy.utils.register_class(operator)
    load_pre.append(cancel_before_loading)


def unregister():
    """Blender calls it at its end, too."""
    cancel_bake()
    load_pre.remove(cancel_before_loading)
    for operator in reversed(CLASSES):
        bpy.utils.unregister_class(operator)
