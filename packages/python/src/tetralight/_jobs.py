# SPDX-License-Identifier: Apache-2.0
"""Runs the command `tetralight` by a JSON job, in a temporary folder, and stops it if the caller is interrupted."""
from __future__ import annotations

import functools
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path
from typing import Any, Callable, Union

from tetralight._arguments import path_text
from tetralight.errors import BadValue, Cancelled, Corrupt, Error, NotFound, OutOfMemory, Unavailable, Unsupported
from tetralight._settings import json_value

StrPath = Union[str, "os.PathLike[str]"]

SECONDS_BETWEEN_LOOKS = 0.1
SECONDS_TO_END = 10.0
SECONDS_OF_HELP = 60.0

_CLASSES: dict[str, type[Error]] = {
    "invalid_argument": BadValue,
    "corrupt": Corrupt,
    "unsupported": Unsupported,
    "not_found": NotFound,
    "unavailable": Unavailable,
    "disk_full": Unavailable,
    "out_of_resources": OutOfMemory,
    "cancelled": Cancelled,
}


def error_of(answer: dict[str, Any]) -> Error:
    """The error that the command reports in `error` of its answer. Other members are its report."""
    facts = answer["error"]
    code = str(facts.get("code", "error"))
    error = _CLASSES.get(code, Error)(str(facts.get("message", "the command failed")), code)
    error.field, error.value = str(facts.get("field", "")), str(facts.get("value", ""))
    error.report = {name: value for name, value in answer.items() if name != "error"} or None
    return error


def find_command(command: StrPath | None = None) -> str:
    """The path of the command: `command`, $TETRALIGHT_COMMAND, or `tetralight` of PATH."""
    asked = path_text("command", command) if command is not None else os.environ.get("TETRALIGHT_COMMAND") or "tetralight"
    found = shutil.which(asked)
    if found is None:
        error = NotFound(f'the command "{asked}" is missing or not a program: install Tetralight, or give its path '
                         "as command= or in TETRALIGHT_COMMAND", "not_found")
        error.field, error.value = "command", asked
        raise error
    return found


def setting_names(program: str, name: str) -> frozenset[str]:
    """Names of the settings of a command, from its --help; empty if it has none."""
    return _setting_names(program, os.stat(program).st_mtime_ns, name)


@functools.lru_cache(maxsize=64)
def _setting_names(program: str, _changed: int, name: str) -> frozenset[str]:
    try:
        answer = subprocess.run([program, name, "--help"], stdin=subprocess.DEVNULL, capture_output=True,
                                timeout=SECONDS_OF_HELP, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return frozenset()  # the job reports what is wrong
    text = answer.stdout.decode(errors="replace") if answer.returncode == 0 else ""
    options = re.findall(r"^  (?:-\w, )?--([a-z][a-z0-9-]*)", text, re.MULTILINE)
    return frozenset(option.replace("-", "_") for option in options) - {"json", "quiet", "help"}


class Job:
    """One run of the command. All its files are in `folder` until `close`, which deletes them."""

    def __init__(self, command: StrPath | None = None) -> None:
        self.program = find_command(command)
        self._temporary = tempfile.TemporaryDirectory(prefix="tetralight_")
        self.folder = Path(self._temporary.name)

    def __enter__(self) -> Job:
        return self

    def __exit__(self, *_: object) -> None:
        self._temporary.cleanup()

    def run(self, name: str, settings: dict[str, Any], look: Callable[[], None] = lambda: None) -> dict[str, Any]:
        """The answer of the command. Calls `look` ten times a second; what it raises stops the command."""
        job = {"command": name, **{key: json_value(key, value) for key, value in settings.items()}}
        job_file, out, err = (self.folder / file for file in ("job.json", "answer.json", "messages.txt"))
        job_file.write_text(json.dumps(job), encoding="utf-8")
        with out.open("wb") as out_file, err.open("wb") as err_file:
            code = self._finish(self._start(job_file, out_file, err_file), look)
        return self._answer(name, code, out, err)

    def _start(self, job_file: Path, out: Any, err: Any) -> subprocess.Popen[bytes]:
        try:
            return subprocess.Popen([self.program, "--job", str(job_file)], stdin=subprocess.DEVNULL, stdout=out,
                                    stderr=err)
        except OSError as reason:
            raise Unavailable(f'the command "{self.program}" cannot be started: {reason.strerror or reason}') from reason

    @staticmethod
    def _finish(process: subprocess.Popen[bytes], look: Callable[[], None]) -> int:
        try:
            while True:
                try:
                    return process.wait(SECONDS_BETWEEN_LOOKS)
                except subprocess.TimeoutExpired:
                    look()
        finally:
            if process.poll() is None:
                _stop(process)

    def _answer(self, name: str, code: int, out: Path, err: Path) -> dict[str, Any]:
        try:
            answer = json.loads(out.read_bytes())
        except ValueError:
            answer = None
        if not isinstance(answer, dict):
            raise Error(self._silence(name, code, err), "command_failed")
        if isinstance(answer.get("error"), dict):
            raise error_of(answer)
        if code != 0:
            raise Error(self._silence(name, code, err), "command_failed")
        return answer

    def _silence(self, name: str, code: int, err: Path) -> str:
        """How a command ended that reported no error."""
        ended = f"ended with code {code}"
        if code < 0:
            try:
                ended = f"was ended by {signal.Signals(-code).name}"
            except ValueError:
                ended = f"was ended by signal {-code}"
        lines = [line for line in err.read_text(encoding="utf-8", errors="replace").splitlines() if line.strip()]
        said = f": {lines[-1][:200]}" if lines else ", without a message"
        return f"{self.program}: `{name}` {ended}{said}"


def _stop(process: subprocess.Popen[bytes]) -> None:
    """Interrupts the command as Ctrl-C does; kills it if it does not end, or at a second Ctrl-C."""
    try:
        if os.name == "posix":
            process.send_signal(signal.SIGINT)
        else:
            process.terminate()
        process.wait(SECONDS_TO_END)
    except subprocess.TimeoutExpired:
        pass
    finally:
        if process.poll() is None:
            process.kill()
            process.wait()
