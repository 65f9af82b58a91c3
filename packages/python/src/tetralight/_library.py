# SPDX-License-Identifier: Apache-2.0
"""Loads the shared library and turns its statuses into exceptions.

The library is looked for in TETRALIGHT_LIBRARY (a path), beside this file, and where the system keeps
libraries."""
from __future__ import annotations

import ctypes
import os
from typing import Any, TypeVar, Union

from tetralight import _declarations as c
from tetralight import errors
from tetralight._arguments import path_text

NAME = "libtetralight.so.0"
HIGHWAY = "libhwy.so.1"

ERRORS: dict[int, tuple[type[errors.Error], str]] = {
    c.BAD_POINTER: (errors.BadValue, "bad_value"),
    c.BAD_VALUE: (errors.BadValue, "bad_value"),
    c.SHORT_BUFFER: (errors.BadValue, "bad_value"),
    c.BAD_FILE: (errors.NotFound, "bad_file"),
    c.NOT_THERE: (errors.NotThere, "not_there"),
    c.OUT_OF_MEMORY: (errors.OutOfMemory, "out_of_memory"),
    c.CORRUPT: (errors.Corrupt, "corrupt"),
    c.UNSUPPORTED: (errors.Unsupported, "unsupported"),
    c.UNAVAILABLE: (errors.Unavailable, "unavailable"),
    c.OUT_OF_RESOURCES: (errors.Unavailable, "out_of_resources"),
    c.DISK_FULL: (errors.Unavailable, "disk_full"),
    c.CANCELLED: (errors.Cancelled, "cancelled"),
}


def library_path() -> str:
    chosen = os.environ.get("TETRALIGHT_LIBRARY")
    if chosen:
        return chosen
    beside = os.path.join(os.path.dirname(os.path.abspath(__file__)), NAME)
    return beside if os.path.exists(beside) else NAME


def load_dependency(path: str) -> None:
    """The wheel may hold Highway, too. Once it is loaded, the library finds it by its name."""
    beside = os.path.join(os.path.dirname(path), HIGHWAY)
    if os.path.exists(beside):
        ctypes.CDLL(beside)


def load() -> ctypes.CDLL:
    path = library_path()
    try:
        load_dependency(path)
        loaded = ctypes.CDLL(path)
        c.declare(loaded)
    except OSError as error:
        raise ImportError(f"{path}: the library of tetralight cannot be loaded: {error}") from error
    except AttributeError as error:
        raise ImportError(f"{path}: not the library of this version of tetralight: {error}") from error
    found = loaded.tetralight_version_string().decode()
    if found.split(".")[:2] != c.VERSION.split(".")[:2]:
        raise ImportError(f"{path}: the library has version {found}, the package needs {c.VERSION}")
    return loaded


library = load()


def version() -> str:
    return str(library.tetralight_version_string().decode())


def call(function: Any, *arguments: Any) -> None:
    """Calls a function whose last parameter is `tetralight_error*`. The interpreter lock is released
    meanwhile. Raises what the status says."""
    error = c.Error()
    status = function(*arguments, ctypes.byref(error))
    if status != c.OK:
        kind, code = ERRORS.get(status, (errors.Error, "error"))
        raise kind(error.message.decode("utf-8", "replace"), code)


class NotCopied:
    """A copy or a pickle would share what the library has opened, or free it twice."""

    def __reduce_ex__(self, protocol: Any) -> Any:
        name = type(self).__name__
        raise TypeError(f"{name}: cannot be copied or pickled: open the file again")


class Handle(NotCopied):
    """What a function of the library has opened; freed with the last reference to it, so that arrays
    that show its memory and calls in other threads keep it open."""

    def __init__(self, pointer: int, free: Any) -> None:
        self.pointer = pointer
        self._free = free

    def __del__(self) -> None:
        self._free(self.pointer)


AnyOpened = TypeVar("AnyOpened", bound="Opened")


class Opened(NotCopied):
    """What is open until `close` or the end of a `with` statement."""

    _closed = "closed"  # the end of the message of `Closed`

    def __init__(self, handle: Handle, name: str) -> None:
        self._handle: Handle | None = handle
        self.name = name

    def close(self) -> None:
        """Calls fail with `Closed` from now on. Arrays that show the file stay valid."""
        self._handle = None

    @property
    def is_closed(self) -> bool:
        return self._handle is None

    def __enter__(self: AnyOpened) -> AnyOpened:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _open_handle(self) -> Handle:
        handle = self._handle
        if handle is None:
            raise errors.Closed(f"{self.name}: {self._closed}")
        return handle



def opened(function: Any, free: Any, *arguments: Any) -> Handle:
    """The handle that a function writes through its last parameter but one."""
    pointer = ctypes.c_void_p()
    call(function, *arguments, ctypes.byref(pointer))
    assert pointer.value is not None
    return Handle(pointer.value, free)


Source = Union[str, "os.PathLike[str]", bytes, bytearray, memoryview]


def opened_file(open_path: Any, open_memory: Any, free: Any, source: Source) -> tuple[Handle, str]:
    """The handle of a file or of its bytes, which are copied, and its name for messages."""
    if isinstance(source, (bytes, bytearray, memoryview)):
        content = bytes(source)
        return opened(open_memory, free, content, len(content)), "memory"
    name = path_text("source", source, "a path or bytes")
    return opened(open_path, free, os.fsencode(name)), name
