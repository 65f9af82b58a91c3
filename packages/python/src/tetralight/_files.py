# SPDX-License-Identifier: Apache-2.0
"""Writes files so that a failure leaves the old file whole, as the library does."""
from __future__ import annotations

import errno
import os
import stat

from tetralight._arguments import path_text
from tetralight.errors import Error, NotFound, Unavailable

# What the library calls `bad_file` and `disk_full`.
_NOT_A_FILE = (errno.ENOENT, errno.ENOTDIR, errno.EISDIR, errno.ELOOP, errno.ENAMETOOLONG)
_DISK_FULL = (errno.ENOSPC, errno.EDQUOT)


def write_file(path: str | os.PathLike[str], *parts: bytes | memoryview) -> None:
    """Writes beside the file and renames. A link stays, and devices are written to directly."""
    name = path_text("path", path)
    target = os.path.realpath(name)
    try:
        if _is_device(target):
            _write(target, parts)
            return
        beside = f"{target}.{os.getpid()}.part"
        try:
            _write(beside, parts)
            os.replace(beside, target)
        except BaseException:
            _remove(beside)
            raise
    except OSError as reason:
        raise _error_of(name, reason) from reason


def _is_device(path: str) -> bool:
    try:
        mode = os.stat(path).st_mode
    except FileNotFoundError:
        return False
    return not stat.S_ISREG(mode) and not stat.S_ISDIR(mode)


def _write(path: str, parts: tuple[bytes | memoryview, ...]) -> None:
    with open(path, "wb") as file:
        for part in parts:
            file.write(part)


def _remove(path: str) -> None:
    try:
        os.unlink(path)
    except OSError:
        pass


def _error_of(name: str, reason: OSError) -> Error:
    message = f"{name}: cannot write ({reason.strerror or reason})"
    if reason.errno in _NOT_A_FILE:
        return NotFound(message)
    return Unavailable(message, "disk_full" if reason.errno in _DISK_FULL else None)
