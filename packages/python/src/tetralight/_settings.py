# SPDX-License-Identifier: Apache-2.0
"""Values of settings as JSON, and names of settings that a command or the service does not have."""
from __future__ import annotations

import difflib
import json
import os
from typing import Any, Iterable

import numpy

from tetralight._arguments import shown
from tetralight.errors import BadValue


def json_value(name: str, value: Any) -> Any:
    """The value of a setting as JSON has it. Paths become text, arrays become lists."""
    plain = _plain(value)
    try:
        json.dumps(plain, allow_nan=False)
    except ValueError as reason:
        raise bad_value(name, plain, "is not a finite number") from reason
    except TypeError as reason:
        raise bad_value(name, value, "is not a number, a text, a path, an array or a dictionary") from reason
    return plain


def _plain(value: Any) -> Any:
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, numpy.ndarray):
        return value.tolist()
    if isinstance(value, numpy.generic):
        return value.item()
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    return value


def bad_value(name: str, value: Any, what: str) -> BadValue:
    """The error of an argument."""
    text = shown(value)
    error = BadValue(f"{name}: {text} {what}", "invalid_argument")
    error.field, error.value = name, text
    return error


def check_names(function: str, given: Iterable[str], known: Iterable[str]) -> None:
    """Raises TypeError for the first name that is not known, as Python does for its own functions."""
    names = sorted(known)
    for name in given:
        if name not in names:
            raise unknown_name(function, name, names)


def unknown_name(function: str, name: str, known: Iterable[str]) -> TypeError:
    """The error of a keyword that a function does not have. Suggests the nearest one."""
    near = difflib.get_close_matches(name, list(known), 1)
    hint = f"; did you mean {near[0]!r}?" if near else ""
    return TypeError(f"{function}() got an unexpected keyword argument {name!r}{hint}")
