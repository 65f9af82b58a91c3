# SPDX-License-Identifier: Apache-2.0
"""Progress of long work: a callback of the caller, or a bar on a terminal or in a notebook."""
from __future__ import annotations

import sys
import time
from typing import Callable, Optional, TextIO, Union

from tetralight._arguments import refused

#: Called several times a second with the finished fraction, or None while it is not known, and one line of text. What
#: it raises stops the work.
Callback = Callable[[Optional[float], str], object]
#: A callback; True: a bar; False: nothing; None: a bar on a terminal and in a notebook.
Progress = Union[Callback, bool, None]

SECONDS_BEFORE_BAR = 1.0
BAR_WIDTH = 24


class Bar:
    """One line of a text stream that is rewritten. Work of less than a second shows nothing."""

    def __init__(self, stream: TextIO | None = None) -> None:
        self._stream = stream or sys.stderr
        self._begin = time.monotonic()
        self._width = 0

    def __call__(self, fraction: float | None, text: str) -> None:
        if time.monotonic() - self._begin < SECONDS_BEFORE_BAR:
            return
        line = text
        if fraction is not None:
            done = round(fraction * BAR_WIDTH)
            line = f"[{'#' * done}{'.' * (BAR_WIDTH - done)}] {fraction:4.0%} {text}"
        self._stream.write("\r" + line.ljust(self._width))
        self._stream.flush()
        self._width = len(line)

    def close(self) -> None:
        """Ends the line, if there is one."""
        if self._width > 0:
            self._stream.write("\n")
            self._stream.flush()


class Silence:
    """Shows nothing."""

    def __call__(self, fraction: float | None, text: str) -> None:
        pass

    def close(self) -> None:
        pass


class _Caller:
    def __init__(self, callback: Callback) -> None:
        self._callback = callback

    def __call__(self, fraction: float | None, text: str) -> None:
        self._callback(fraction, text)

    def close(self) -> None:
        pass


def reporter(progress: Progress) -> Bar | Silence | _Caller:
    """What shows the progress of one piece of work."""
    if callable(progress):
        return _Caller(progress)
    if progress is not None and not isinstance(progress, bool):
        raise refused("progress", "a function, True, False or None", progress)
    if progress is None:
        progress = "ipykernel" in sys.modules or bool(sys.stderr and sys.stderr.isatty())
    return Bar() if progress else Silence()


def counted(what: str, done: int, count: int, seconds_left: float | None) -> tuple[float | None, str]:
    """Fraction and text of counted work."""
    if count <= 0:
        return None, what
    text = f"{what}: {done} of {count}"
    if seconds_left is not None and done < count:
        text += f", {seconds_left:.0f} s left"
    return min(done / count, 1.0), text
