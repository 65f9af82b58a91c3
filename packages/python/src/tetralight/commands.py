# SPDX-License-Identifier: Apache-2.0
"""Places probes, bakes and checks light with the command `tetralight`.

    grid = tetralight.grid("court.glb", spacing=2)
    volume = tetralight.bake("court.glb", positions=grid.positions, samples=256)
    tetralight.check_leaks("court.glb", volume, max_leak="1%")

Keywords are the settings that `tetralight COMMAND --help` lists, with underscores. The command is found by `command`,
$TETRALIGHT_COMMAND or PATH. It runs in a temporary folder: a failure, KeyboardInterrupt, or what `progress` raises
stops it and leaves no file.
"""
from __future__ import annotations

import json
import os
import shutil
import warnings
import weakref
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Sequence, Union

import numpy

import tetralight
from tetralight._arguments import path_text, refused
from tetralight._jobs import Job, StrPath, setting_names
from tetralight._positions import Positions, checked_positions, read_groups, write_groups
from tetralight._progress import Progress, counted, reporter
from tetralight._settings import bad_value, check_names
from tetralight.errors import Error, Unavailable

if TYPE_CHECKING:
    from tetralight import Volume

Scene = Union[StrPath, bytes]
Groups = Union[Mapping[str, Positions], StrPath, Sequence[StrPath]]

# Settings of the command that `bake` does not have, and what has their place.
_NOT_FOR_BAKE = {
    "explain": 'call run("explain", scene=...)',
    "prepared": 'call run("bake", ...)',
    "probes": 'the result is not a volume: call run("bake", ...)',
    "progress_file": "use progress",
    "resume": "give a folder as chunks",
}


@dataclass(frozen=True)
class Grid:
    """Probes that `grid` placed."""

    #: (N, 3), metres.
    positions: numpy.ndarray[Any, Any]
    #: The positions of each group: views of `positions`.
    groups: dict[str, numpy.ndarray[Any, Any]]
    #: The report of the command: coverage, spaces, what was left out.
    report: dict[str, Any]

    def __len__(self) -> int:
        return len(self.positions)


def grid(scene: Scene, *, command: StrPath | None = None, progress: Progress = None, **settings: Any) -> Grid:
    """Fills a scene with probes (`tetralight grid`): positions, and groups for `bake`."""
    with Job(command) as job:
        _check_names(job, "grid", settings, {"output"})
        output = job.folder / "groups.json"
        files = {"scene": _file(job, scene, "scene.glb"), "output": output}
        report = _run(job, "grid", {**settings, **files}, progress, "placing probes")
        report.pop("output", None)
        groups = read_groups(output)
    positions = numpy.concatenate([numpy.empty((0, 3)), *groups.values()])
    ends = numpy.cumsum([len(group) for group in groups.values()])
    return Grid(positions, dict(zip(groups, numpy.split(positions, ends[:-1]))), report)


def bake(
    scene: Scene,
    positions: Positions | None = None,
    groups: Groups | None = None,
    *,
    output: StrPath | None = None,
    command: StrPath | None = None,
    progress: Progress = None,
    **settings: Any,
) -> Volume:
    """Bakes the light of a scene into a probe volume (`tetralight bake`), and opens it.

    `positions` (N, 3) are all probes of the volume. `groups` are files, or positions by name, in addition to the
    scene's own groups. Without both the scene has the probes. With `output` the volume is also kept in that file,
    which is replaced as a whole."""
    if positions is not None and groups is not None:
        raise TypeError("bake() accepts positions or groups, not both")
    for name, instead in _NOT_FOR_BAKE.items():
        if name in settings:
            raise TypeError(f"bake() does not accept {name!r}: {instead}")
    if output is not None:
        _check_output(Path(path_text("output", output)))
    if positions is not None:
        groups = {"positions": checked_positions("positions", positions)}
        settings.setdefault("only_given_groups", True)
    with Job(command) as job:
        _check_names(job, "bake", settings, {*_NOT_FOR_BAKE, "groups", "output"})
        result = job.folder / "result.probes"
        files = {"scene": _file(job, scene, "scene.glb"), "groups": _group_files(job, groups), "output": result}
        _run(job, "bake", {**settings, **files}, progress, "baking", "probe")
        if not result.is_file():
            raise Error(f"{job.program}: `bake` wrote no volume", "command_failed")
        if output is None:
            return _opened(result.read_bytes())
        _replace(result, Path(output))
    return tetralight.open(output)


def check_leaks(
    scene: Scene,
    volume: Volume | Scene,
    *,
    command: StrPath | None = None,
    progress: Progress = None,
    **settings: Any,
) -> dict[str, Any]:
    """Compares a volume's light with traced light (`tetralight check-leaks`): the report.

    With `max_leak`, raises an error with the `report` if more light comes through walls."""
    return _compare("check-leaks", scene, volume, command, progress, settings)


def verify(
    scene: Scene,
    volume: Volume | Scene,
    *,
    command: StrPath | None = None,
    progress: Progress = None,
    **settings: Any,
) -> dict[str, Any]:
    """Compares a volume's light with that of an independent path tracer (`tetralight verify`): the report.

    Raises an error with the `report` if a limit is exceeded."""
    return _compare("verify", scene, volume, command, progress, settings)


def run(name: str, /, *, command: StrPath | None = None, progress: Progress = None, **settings: Any) -> dict[str, Any]:
    """Runs any command by its settings, positional arguments in lower case: the answer of `--json`."""
    if not isinstance(name, str):
        raise refused("name", "the name of a command", name)
    with Job(command) as job:
        return _run(job, name, settings, progress, name)


def _compare(
    name: str,
    scene: Scene,
    volume: Volume | Scene,
    command: StrPath | None,
    progress: Progress,
    settings: dict[str, Any],
) -> dict[str, Any]:
    with Job(command) as job:
        _check_names(job, name, settings, {"scene"})
        files = {"scene": _file(job, scene, "scene.glb"), "volume": _volume_file(job, volume)}
        report = _run(job, name, {**settings, **files}, progress, "tracing light", depth=4)
    report.pop("file", None)
    return report


def _check_names(job: Job, name: str, settings: dict[str, Any], without: set[str]) -> None:
    known = setting_names(job.program, name)
    if known:  # a program without this command says so itself
        check_names(name.replace("-", "_"), settings, known - without)


def _run(
    job: Job,
    name: str,
    settings: dict[str, Any],
    progress: Progress,
    text: str,
    unit: str | None = None,
    depth: int = 3,
) -> dict[str, Any]:
    """Runs a job and shows its progress. `unit` is what the progress file of the command counts; `depth` is the number
    of calls from the caller of the package to here, for warnings."""
    show = reporter(progress)
    progress_file = job.folder / "progress.json"
    if unit is not None:
        settings = {**settings, "progress_file": progress_file}
    try:
        show(None, text)
        answer = job.run(name, settings, lambda: show(*_look(progress_file, text, unit)))
        show(1.0, f"{text}: done")
    finally:
        show.close()
    for warning in answer.pop("warnings", None) or []:
        warnings.warn(f"tetralight {name}: {warning}", stacklevel=depth)
    return answer


def _look(progress_file: Path, text: str, unit: str | None) -> tuple[float | None, str]:
    if unit is None:
        return None, text
    try:
        facts = json.loads(progress_file.read_bytes())
    except (OSError, ValueError):
        return None, text  # not yet
    return counted(f"{text} {unit}s", facts.get(f"{unit}s_done", 0), facts.get(f"{unit}_count", 0),
                   facts.get("seconds_left"))


def _file(job: Job, source: Scene, name: str) -> Path:
    """The path of a file; bytes are written to the folder of the job."""
    if isinstance(source, (bytes, bytearray, memoryview)):
        path = job.folder / name
        path.write_bytes(source)
        return path
    return Path(path_text(name.split(".")[0], source, "a path or bytes"))


def _volume_file(job: Job, volume: Volume | Scene) -> Path:
    if not isinstance(volume, tetralight.Volume):
        return _file(job, volume, "volume.probes")
    if volume in _baked:
        return _file(job, _baked[volume], "volume.probes")
    if not os.path.isfile(volume.name):
        raise bad_value("volume", volume, "is not open from a file: give its path or bytes")
    return Path(volume.name)


# The bytes of open volumes that have no file.
_baked: weakref.WeakKeyDictionary[Volume, bytes] = weakref.WeakKeyDictionary()


def _opened(data: bytes) -> Volume:
    volume = tetralight.open(data)
    _baked[volume] = data
    return volume


def _group_files(job: Job, groups: Groups | None) -> list[Path]:
    if groups is None:
        return []
    if isinstance(groups, Mapping):
        path = job.folder / "given.json"
        write_groups(path, groups)
        return [path]
    if isinstance(groups, (str, os.PathLike)):
        groups = [groups]
    if not isinstance(groups, Iterable) or isinstance(groups, bytes):
        raise refused("groups", "positions by name, or paths", groups)
    return [Path(path_text("groups", file)) for file in groups]


def _check_output(output: Path) -> None:
    """Refuses a file that cannot be written, before the work."""
    folder = output.parent
    if output.is_dir():
        raise bad_value("output", str(output), "is a folder")
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        raise bad_value("output", str(output), "is not in a folder that can be written to")


def _replace(result: Path, output: Path) -> None:
    """Copies a file to its place: the old one stays whole until the new one is."""
    beside = output.with_name(f".{output.name}.{os.getpid()}.new")
    try:
        shutil.copyfile(result, beside)
        os.replace(beside, output)
    except OSError as reason:
        error = Unavailable(f"{output} cannot be written: {reason.strerror or reason}", "unavailable")
        error.field, error.value = "output", str(output)
        raise error from reason
    finally:
        beside.unlink(missing_ok=True)
