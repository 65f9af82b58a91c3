# SPDX-License-Identifier: Apache-2.0
"""Run by a Blender with a window: draws the panels, bakes by its buttons' operators, and cancels by Esc.

Each step is a function that yields while Blender works: events, drawing and timers go on between its parts.
"""
import os
import sys
import time
import traceback
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "packages/blender")]

import addon_utils  # noqa: E402
import bpy  # noqa: E402
from tetralight import operators, panels  # noqa: E402
from tetralight.show_probes import shown_probes  # noqa: E402

FOLDER = Path(sys.argv[-1])
SECONDS_OF_A_STEP = 120


def wait_until(is_so, what):
    end = time.monotonic() + SECONDS_OF_A_STEP
    while not is_so():
        assert time.monotonic() < end, f"{what} did not happen"
        yield


def window_context():
    window = bpy.context.window_manager.windows[0]
    area, = [area for area in window.screen.areas if area.type == "VIEW_3D"]
    region, = [region for region in area.regions if region.type == "WINDOW"]
    return {"window": window, "screen": window.screen, "area": area, "region": region}


def show_tab():
    """Puts the panels into the tab that a new file shows: scripts cannot choose a tab."""
    for panel in panels.CLASSES:
        if hasattr(panel, "bl_category"):
            bpy.utils.unregister_class(panel)
            panel.bl_category = "Item"
            bpy.utils.register_class(panel)
    window_context()["area"].spaces.active.show_region_ui = True


def prepare():
    addon_utils.enable("tetralight", default_set=True)
    bpy.context.preferences.addons["tetralight"].preferences.command = os.environ["TETRALIGHT_COMMAND"]
    show_tab()
    yield from add_scene()


def add_scene():
    settings = bpy.context.scene.tetralight
    settings.quality, settings.output = "SAMPLES", str(FOLDER / "scene.probes")
    with bpy.context.temp_override(**window_context()):
        bpy.ops.tetralight.add_probe_group(size=(4, 4, 2), spacing=1, location=(0, 0, 2))
    yield


def draw_panels():
    """Once for each kind of object."""
    with bpy.context.temp_override(**window_context()):
        for kind in operators.HELPERS:
            bpy.ops.tetralight.add_helper(kind=kind)
    bpy.data.objects["Cube"].tetralight_contribute_gi = "0"
    for thing in [*bpy.context.scene.objects, None]:
        bpy.context.view_layer.objects.active = thing
        with bpy.context.temp_override(**window_context()):
            bpy.ops.wm.redraw_timer(type="DRAW_WIN", iterations=1)
        yield
    for kind in operators.HELPERS.values():
        bpy.data.objects.remove(bpy.data.objects[kind[0]])


def cancel_by_escape():
    (FOLDER / "scene.probes").write_bytes(b"old")
    bpy.context.scene.tetralight.samples = 16777216
    with bpy.context.temp_override(**window_context()):
        assert bpy.ops.tetralight.bake("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    bake = operators.running.bake
    yield from wait_until(lambda: bake.progress.fraction is not None, "progress")
    window = bpy.context.window_manager.windows[0]
    window.event_simulate("ESC", "PRESS", x=400, y=400)
    window.event_simulate("ESC", "RELEASE", x=400, y=400)
    yield from wait_until(lambda: operators.running is None, "cancelling")
    assert bake.is_over() and not bake.scene.parent.exists()
    assert (FOLDER / "scene.probes").read_bytes() == b"old"
    assert shown_probes(bpy.context.scene) is None


def cancel_by_the_button():
    with bpy.context.temp_override(**window_context()):
        bpy.ops.tetralight.bake("INVOKE_DEFAULT")
        bake = operators.running.bake
        bpy.ops.tetralight.cancel_bake()
    yield from wait_until(lambda: not bake.scene.parent.exists(), "cancelling")
    assert (FOLDER / "scene.probes").read_bytes() == b"old"


def cancel_by_loading_a_file():
    """Nothing of the bake is left, and the next one can begin."""
    with bpy.context.temp_override(**window_context()):
        assert bpy.ops.tetralight.bake("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    bake = operators.running.bake
    yield from wait_until(lambda: bake.progress.fraction is not None, "progress")
    bpy.ops.wm.read_homefile()
    yield from wait_until(lambda: operators.running is None, "cancelling")
    assert bake.is_over() and not bake.scene.parent.exists()
    yield  # Blender makes its windows
    yield from add_scene()


def bake_to_the_end():
    """At once after the bake that the button ended, whose operator has not noticed yet."""
    bpy.context.scene.tetralight.samples = 64
    with bpy.context.temp_override(**window_context()):
        assert bpy.ops.tetralight.bake("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield from wait_until(lambda: operators.running is None, "the end of the bake")
    assert (FOLDER / "scene.probes").read_bytes() != b"old"
    assert shown_probes(bpy.context.scene)
    with bpy.context.temp_override(**window_context()):
        bpy.ops.wm.redraw_timer(type="DRAW_WIN", iterations=1)
    yield


def all_steps():
    for step in (prepare, draw_panels, cancel_by_escape, cancel_by_loading_a_file, cancel_by_the_button, bake_to_the_end):
        print("step:", step.__name__, flush=True)
        yield from step()


steps = all_steps()


def advance():
    """Called by Blender ten times a second."""
    try:
        next(steps)
    except StopIteration:
        print("all steps passed", flush=True)
        os._exit(0)
    except BaseException:
        traceback.print_exc()
        os._exit(1)
    return 0.1


bpy.app.timers.register(advance, first_interval=0.5, persistent=True)
