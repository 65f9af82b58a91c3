# SPDX-License-Identifier: Apache-2.0
"""One query of many positions, cut into tasks that run on all cores."""
from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np

from tetralight import _arguments, _arrays
from tetralight import _declarations as c
from tetralight._arguments import choice, refused, wrong_shape
from tetralight._arrays import AnyArray
from tetralight._library import call, library
from tetralight._threads import parallel_for, thread_count
from tetralight.errors import BadValue
from tetralight.light import FORMATS, Light

TASK_SIZE = 32768

OUTSIDE = {"extrapolate": c.EXTRAPOLATE, "clamp": c.CLAMP, "ambient": c.AMBIENT}
WALLS = {"hide": c.HIDE_PROBES, "ignore": c.IGNORE_WALLS}


class Options(NamedTuple):
    """What `Volume.query` explains."""

    format: str
    outside: str
    fade_distance: float
    walls: str
    rendering_layers: Any
    radii: Any
    normals: Any
    normal_offset: float
    threads: int | None


def outputs(shape: tuple[int, ...], hints: Any, out: Any, format: str) -> Light:
    """Memory of the answers: the caller's, or new."""
    row, kind = choice("format", format, FORMATS)
    if isinstance(out, Light):
        if out.format != format:
            raise BadValue(f"out: expected the format {format!r}, given {out.format!r}")
        _arrays.output("out.sh", out.sh, shape + row, kind)
        _arrays.output("out.occlusion", out.occlusion, shape + (4,), np.float32)
        cells = cells_of(shape, hints, out.cells)
        out.cells = cells
        return out
    sh = np.empty(shape + row, kind) if out is None else _arrays.output("out", out, shape + row, kind)
    return Light(sh, format, np.empty(shape + (4,), np.float32), cells_of(shape, hints, None))


def cells_of(shape: tuple[int, ...], hints: Any, memory: AnyArray | None) -> AnyArray:
    """The array that gives and receives hints. Without hints it holds NO_CELL."""
    if hints is None and memory is None:
        return np.full(shape, c.NO_CELL, np.uint32)
    name, given = ("hints", hints) if hints is not None else ("out.cells", memory)
    cells = _arrays.output(name, given, shape, np.uint32)
    if not cells.flags.c_contiguous:
        raise BadValue(f"{name}: expected an array without gaps, given the strides {cells.strides}")
    if hints is None:
        cells[...] = c.NO_CELL
    return cells


def check_radii(radii: AnyArray) -> None:
    """What the library would find only when it comes to the position."""
    is_wrong = ~((radii >= 0) & np.isfinite(radii))
    if is_wrong.any():
        raise refused("radii", "finite numbers >= 0", float(radii[is_wrong][0]))


class Task:
    """The arrays of a batch as rows, of which each task answers a slice."""

    def __init__(self, volume: int, positions: AnyArray, light: Light, options: Options) -> None:
        shape = positions.shape[:-1]
        radii = optional("radii", options.radii, shape, np.float32)
        if radii is not None:
            check_radii(radii)
        self.volume = volume
        self.count = light.cells.size
        arrays = {
            "positions": input_rows("positions", positions),
            "hints": light.cells.reshape(-1),
            "sh": _arrays.rows("out", light.sh, 2),
            "occlusion": _arrays.rows("out.occlusion", light.occlusion, 1),
            "rendering_layers": optional("rendering_layers", options.rendering_layers, shape, np.uint32),
            "radii": radii,
            "normals": surface_normals(options.normals, shape),
        }
        self.rows = {name: _arrays.Rows(array) for name, array in arrays.items() if array is not None}
        self.batch = c.Batch(
            sh_format=list(FORMATS).index(light.format),
            outside=choice("outside", options.outside, OUTSIDE),
            fade_distance=_arguments.number("fade_distance", options.fade_distance),
            walls=choice("walls", options.walls, WALLS),
            normal_offset=_arguments.number(
                "normal_offset", options.normal_offset, 0, expected="a finite number >= 0"
            ),
        )

    def answer(self, begin: int, end: int) -> c.Report:
        batch = c.Batch.from_buffer_copy(self.batch)
        batch.count = end - begin
        for name, rows in self.rows.items():
            setattr(batch, name, rows.part(begin, end))
        report = c.Report()
        call(library.tetralight_query_batch, self.volume, ctypes.byref(batch), ctypes.byref(report))
        return report


def input_rows(name: str, array: AnyArray) -> AnyArray:
    """Inputs with other gaps than the library knows are copied."""
    try:
        return _arrays.rows(name, array, 1)
    except BadValue:
        return np.ascontiguousarray(array).reshape(-1, array.shape[-1])


def optional(name: str, values: Any, shape: tuple[int, ...], dtype: Any) -> AnyArray | None:
    return None if values is None else _arrays.each(name, values, shape, dtype).reshape(-1)


def surface_normals(normals: Any, shape: tuple[int, ...]) -> AnyArray | None:
    if normals is None:
        return None
    array = _arrays.vectors("normals", normals)
    if array.shape not in ((3,), shape + (3,)):
        raise wrong_shape("normals", f"{shape + (3,)} or (3,)", array.shape)
    return np.ascontiguousarray(np.broadcast_to(array, shape + (3,))).reshape(-1, 3)


def answer(volume: int, positions: AnyArray, light: Light, options: Options) -> Light:
    """Fills `light`. Fails before the first answer if an argument is wrong."""
    task = Task(volume, positions, light, options)
    threads = thread_count(options.threads)
    if task.count <= TASK_SIZE:
        reports = [task.answer(0, task.count)]
    else:
        task.answer(0, 0)  # checks the options
        reports = answer_in_parallel(task, threads)
    light.not_finite_count = sum(report.not_finite_count for report in reports)
    light.step_count = sum(report.step_count for report in reports)
    return light


def answer_in_parallel(task: Task, threads: int) -> list[c.Report]:
    count = -(-task.count // TASK_SIZE)
    reports = [c.Report()] * count

    def run(number: int) -> None:
        begin = number * TASK_SIZE
        reports[number] = task.answer(begin, min(begin + TASK_SIZE, task.count))

    parallel_for(count, run, threads)
    return reports
