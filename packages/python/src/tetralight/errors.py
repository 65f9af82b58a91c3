# SPDX-License-Identifier: Apache-2.0
"""Errors of the library. Programs branch on the class or on `code`, never on the message."""
from __future__ import annotations

from typing import Any


class Error(Exception):
    """What went wrong: `code` is a name such as "corrupt", `message` one line for people.

    Errors of the command and the service also have the `field` that is at fault and its `value`, and the `report` of
    a command that failed with results."""

    code = "error"
    field = ""
    value = ""
    report: dict[str, Any] | None = None

    def __init__(self, message: str, code: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        if code is not None:
            self.code = code


class BadValue(Error, ValueError):
    """An argument has the wrong shape, type or value."""

    code = "bad_value"


class NotFound(Error, FileNotFoundError):
    """There is no such file, or the path does not lead to a regular file."""

    code = "bad_file"


class NotThere(Error, LookupError):
    """The volume, the lightmaps or the reflection probes do not contain the requested item."""

    code = "not_there"


class Corrupt(Error):
    """The bytes of the file are wrong: opening it again fails again."""

    code = "corrupt"


class Unsupported(Error):
    """The file is valid, but this version of the library cannot read it."""

    code = "unsupported"


class Unavailable(Error, OSError):
    """The file cannot be read or written now: try again later."""

    code = "unavailable"


class OutOfMemory(Error, MemoryError):
    """The system refuses memory."""

    code = "out_of_memory"


class Cancelled(Error):
    """The caller stopped the work."""

    code = "cancelled"


class Closed(Error, ValueError):
    """The object was closed before this call."""

    code = "closed"
