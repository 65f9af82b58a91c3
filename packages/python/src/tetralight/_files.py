# SPDX-License-Identifier: Apache-2.0
"""Writes files so that a failure leaves the old file whole."""
from __future__ import annotations

import os

from tetralight.errors import Unavailable


def write_file(path: str | os.PathLike[str], *parts: bytes | memoryview) -> None:
    """Writes beside the file and renames."""
    name = os.fspath(path)
    beside = f"{name}.{os.getpid()}.part"
    try:
        with open(beside, "wb") as file:
            for part in parts:
                file.write(part)
        os.replace(beside, name)
    except OSError as error:
        try:
            os.unlink(beside)
        except OSError:
            pass
        raise Unavailable(f"{name}: the file cannot be written: {error.strerror}") from error
