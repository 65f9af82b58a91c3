# SPDX-License-Identifier: Apache-2.0
"""Bakes an exported scene with the command or the service, in a thread of its own. Needs no Blender.

    bake = CommandBake("tetralight", settings)     # or ServiceBake(service, settings)
    bake.scene                                     # write the scene here
    bake.start()
    while not bake.is_over(): show(bake.progress)
    bake.move_result(path)                         # or bake.error
    bake.close()

All files are in a temporary folder until `move_result`, so that a bake that fails or is cancelled changes nothing.
"""
import hashlib
import json
import os
import shutil
import subprocess
import tempfile
import threading
import time
import urllib.parse
from dataclasses import dataclass, field
from pathlib import Path

from .service import ServiceError

SECONDS_BETWEEN_LOOKS = 0.1
SECONDS_BETWEEN_REQUESTS = 0.5
SECONDS_OFFLINE = 60  # a service may be away as long while it bakes
SECONDS_TO_END = 5


@dataclass
class BakeSettings:
    """`order` has settings of `tetralight bake` by the names that jobs give them."""

    order: dict = field(default_factory=dict)
    grid_spacing: float | None = None  # metres; None: the scene has probe groups
    sky: Path | None = None  # an image, .hdr or .exr; None: the sky of the scene
    name: str = ""  # of scene and volume in the service; empty: none


@dataclass(frozen=True)
class Progress:
    text: str
    fraction: float | None = None  # None: not known
    seconds_left: float | None = None


class BakeError(Exception):
    """A bake failed, with a message for the user."""


class Cancelled(Exception):
    """The user cancelled the bake."""


class Bake:
    """A bake in a thread. Its subclasses define `_run`."""

    def __init__(self, settings):
        self.settings = settings
        self.progress = Progress("Exporting the scene")
        self.error = None
        self.warnings = []
        self._folder = tempfile.TemporaryDirectory(prefix="tetralight_")
        self._is_cancelled = threading.Event()
        self._thread = threading.Thread(target=self._work, name="tetralight bake", daemon=True)
        folder = Path(self._folder.name)
        self.scene = folder / "scene.glb"
        self.result = folder / "scene.probes"
        self._groups = folder / "groups.json"
        self._progress_file = folder / "progress.json"

    def start(self):
        self._thread.start()

    def is_over(self):
        return not self._thread.is_alive()

    def cancel(self):
        """Ends the bake. Nothing of it is left."""
        self._is_cancelled.set()
        if self._thread.ident:
            self._thread.join(SECONDS_TO_END)
        self.close()

    def close(self):
        """Deletes the temporary files; a thread that still waits for an answer deletes them at its end."""
        if self.is_over():
            self._folder.cleanup()

    def move_result(self, target):
        """Moves the finished volume to its place; an old file is replaced as a whole."""
        beside = target.with_name(f".{target.name}.{os.getpid()}.new")
        try:
            shutil.copyfile(self.result, beside)
            os.replace(beside, target)
        except OSError as error:
            beside.unlink(missing_ok=True)
            raise BakeError(f"{target} cannot be written: {error.strerror or error}") from error

    def _work(self):
        try:
            self._run()
        except Cancelled:
            pass
        except (BakeError, ServiceError, OSError) as error:
            self.error = str(error)
        except Exception as error:  # a fault of this add-on: the user sees it, too
            self.error = f"the add-on failed: {type(error).__name__}: {error}"
            raise
        finally:
            if self._is_cancelled.is_set():
                self._folder.cleanup()

    def _run(self):
        raise NotImplementedError

    def _pause(self, seconds):
        if self._is_cancelled.wait(seconds):
            raise Cancelled

    def _check_cancelled(self):
        self._pause(0)

    def _show_probes(self, facts):
        done, count = facts.get("probes_done") or 0, facts.get("probe_count") or 0
        if count:
            self.progress = Progress(f"Baking probe {done} of {count}", done / count, facts.get("seconds_left"))


class CommandBake(Bake):
    """Bakes with the program `tetralight` of this machine."""

    def __init__(self, command, settings):
        super().__init__(settings)
        self._command = command

    def _run(self):
        groups = []
        inputs = {"scene": str(self.scene)}
        if self.settings.sky:
            inputs["sky"] = str(self.settings.sky)
        if self.settings.grid_spacing is not None:
            self.progress = Progress("Placing probes")
            spacing = self.settings.grid_spacing
            self._job({"command": "grid", **inputs, "output": str(self._groups), "spacing": spacing})
            groups = [str(self._groups)]
        self.progress = Progress("Starting the bake")
        self._job({**self.settings.order, "command": "bake", **inputs, "output": str(self.result), "groups": groups,
                   "progress_file": str(self._progress_file)})
        if not self.result.is_file():
            raise BakeError(f'"{self._command}" wrote no probe volume: is it Tetralight?')

    def _job(self, job):
        """Runs one job of the command (docs/command.md of Tetralight) and takes its warnings."""
        out, err, job_file = (self.scene.with_name(name) for name in ("out.txt", "err.txt", "job.json"))
        job_file.write_text(json.dumps(job))
        with out.open("wb") as out_file, err.open("wb") as err_file:
            code = self._wait(self._start([self._command, "--job", str(job_file)], out_file, err_file))
        answer = _json_object(out)
        if code != 0 or answer is None:
            raise BakeError(self._failure(code, answer, err))
        self.warnings += answer.get("warnings", [])

    def _start(self, arguments, out, err):
        if not self._command:
            raise BakeError("the path of the command is empty: set it in the preferences of the add-on")
        flags = getattr(subprocess, "CREATE_NO_WINDOW", 0)  # Windows only
        try:
            return subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=out, stderr=err, creationflags=flags)
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or error
            raise BakeError(f'the command "{self._command}" cannot be started: {reason}. '
                            "Set its path in the preferences of the add-on") from error

    def _wait(self, process):
        """The exit code. Ends the process if the user cancels."""
        try:
            while process.poll() is None:
                self._show_probes(_json_object(self._progress_file) or {})
                self._pause(SECONDS_BETWEEN_LOOKS)
            return process.returncode
        finally:
            if process.poll() is None:
                process.kill()  # its files are in the temporary folder
                process.wait()

    def _failure(self, code, answer, err):
        error = (answer or {}).get("error")
        if isinstance(error, dict) and "message" in error:
            return str(error["message"]).replace(f"{self.scene.parent}{os.sep}", "")
        lines = err.read_text(errors="replace").split("\n")
        said = next((line for line in reversed(lines) if line.strip()), "nothing on its standard error")
        return f'"{self._command}" ended with code {code} and does not answer as Tetralight does: {said[:200]}'


class ServiceBake(Bake):
    """Bakes with a service (docs/server.md of Tetralight)."""

    def __init__(self, service, settings):
        super().__init__(settings)
        self._service = service

    def _run(self):
        name = {"name": self.settings.name} if self.settings.name else {}
        self.progress = Progress("Uploading the scene")
        path = "/v1/scenes" + (f"?name={urllib.parse.quote(self.settings.name, safe='')}" if name else "")
        inputs = {"scene": self._service.upload(path, self.scene, "model/gltf-binary")["id"]}
        self._check_cancelled()
        if self.settings.sky:
            inputs["sky"] = self._service.upload("/v1/skies", self.settings.sky, "application/octet-stream")["id"]
            self._check_cancelled()
        groups = []
        if self.settings.grid_spacing is not None:
            self.progress = Progress("Placing probes")
            order = {**inputs, "spacing": self.settings.grid_spacing}
            groups = [self._service.post("/v1/grid", order)["id"]]
            self._check_cancelled()
        order = {**self.settings.order, **inputs, "groups": groups, **name}
        self._download(self._finished(self._service.post("/v1/bakes", order)["id"]))

    def _finished(self, bake):
        """Waits for the bake, and returns the id of its volume."""
        path = "/v1/bakes/" + urllib.parse.quote(bake, safe="")
        is_over = False
        try:
            while True:
                facts = self._answer_of_now_or_later(path)
                is_over = facts["state"] not in ("queued", "running")
                if facts["state"] == "done":
                    return facts["volume"]
                if is_over:
                    reason = facts.get("error") or "the bake was " + facts["state"]
                    raise BakeError(f"{self._service.address}: {reason}")
                if facts["state"] == "queued":
                    self.progress = Progress("Waiting for other bakes")
                self._show_probes(facts)
                self._pause(SECONDS_BETWEEN_REQUESTS)
        finally:
            if not is_over:
                self._end(path)

    def _answer_of_now_or_later(self, path):
        """An accepted bake survives a restart of its service: asks again for a while."""
        end = time.monotonic() + SECONDS_OFFLINE
        while True:
            try:
                return self._service.get(path)
            except ServiceError as error:
                if not error.may_pass or time.monotonic() > end:
                    raise
            self._pause(SECONDS_BETWEEN_REQUESTS)

    def _end(self, path):
        try:
            self._service.post(path + "/cancel")
        except ServiceError:
            pass  # it has ended by itself, or the service is away

    def _download(self, volume):
        self.progress = Progress("Downloading the probes")
        self._check_cancelled()
        self._service.download(f"/v1/volumes/{urllib.parse.quote(volume, safe='')}/file", self.result)
        if hashlib.sha256(self.result.read_bytes()).hexdigest() != volume:
            raise BakeError(f"{self._service.address}: the bytes of the volume do not have its id {volume}")


def _json_object(path):
    """The JSON object in a file; None if there is none, or not yet."""
    try:
        value = json.loads(path.read_text())
    except (OSError, ValueError):
        return None
    return value if isinstance(value, dict) else None
