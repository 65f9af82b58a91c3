# SPDX-License-Identifier: Apache-2.0
"""Checks arguments of callers. Errors name the argument, what was expected and what was given."""
from __future__ import annotations

import os
from typing import Any, Mapping

import numpy as np

from tetralight.errors import BadValue

LARGEST_FLOAT = 3.4028234663852886e38
LARGEST_INDEX = 2**32 - 1
_LONGEST_VALUE = 80


def shown(value: Any) -> str:
    """A value on one line of a message."""
    try:
        text = " ".join(repr(value).split())
    except Exception:  # a repr of the caller, or an integer with too many digits
        text = f"an object of the type {type(value).__name__}"
    return text if len(text) <= _LONGEST_VALUE else text[: _LONGEST_VALUE - 1] + "…"


def refused(name: str, expected: str, given: Any, code: str = "bad_value") -> BadValue:
    """The error of an argument."""
    text = shown(given)
    error = BadValue(f"{name}: expected {expected}, given {text}", code)
    error.field, error.value = name, text
    return error


def wrong_shape(name: str, expected: object, given: object) -> BadValue:
    error = BadValue(f"{name}: expected the shape {expected}, given {given}")
    error.field, error.value = name, str(given)
    return error


def number(
    name: str,
    value: Any,
    lowest: float = -LARGEST_FLOAT,
    highest: float = LARGEST_FLOAT,
    expected: str = "a finite number",
) -> float:
    """A number that a float of 32 bits can hold. `expected` says the limits to the caller."""
    plain = _plain(value)
    if not isinstance(plain, (int, float)) or not lowest <= plain <= highest:
        raise refused(name, expected, value)
    return float(plain)


def integer(name: str, value: Any, lowest: int = 0, highest: int = LARGEST_INDEX) -> int:
    plain = _plain(value)
    if not isinstance(plain, int) or not lowest <= plain <= highest:
        raise refused(name, f"an integer from {lowest} to {highest}", value)
    return plain


def _plain(value: Any) -> Any:
    """The number of Python that a number of NumPy is. None for truth values, which are integers of Python."""
    if isinstance(value, (np.generic, np.ndarray)) and value.ndim == 0:
        value = value.item()
    return None if isinstance(value, bool) else value


def choice(name: str, value: Any, choices: Mapping[str, Any]) -> Any:
    if not isinstance(value, str) or value not in choices:
        raise refused(name, ", ".join(map(repr, choices)), value)
    return choices[value]


def numbers(name: str, values: Any, expected: str = "numbers", kinds: str = "fiu") -> np.ndarray[Any, Any]:
    """An array of any shape, without a copy where it is one already."""
    try:
        array = np.asarray(values)
    except Exception:  # rows of different lengths, or what an object of the caller raises
        raise refused(name, expected, values) from None
    if array.dtype.kind not in kinds:
        raise refused(name, expected, array.dtype if isinstance(values, np.ndarray) else values)
    return array


def finite_numbers(
    name: str,
    values: Any,
    shape: tuple[int, ...],
    lowest: float = -LARGEST_FLOAT,
    highest: float = LARGEST_FLOAT,
) -> np.ndarray[Any, Any]:
    """A few numbers that floats of 32 bits can hold, as doubles: a copy."""
    expected = "finite numbers"
    if highest < LARGEST_FLOAT:
        expected = f"numbers from {lowest:g} to {highest:g}"
    elif lowest == 0:
        expected = "finite numbers >= 0"
    array = numbers(name, values, f"{expected} of the shape {shape}")
    if array.shape != shape:
        raise wrong_shape(name, shape, array.shape)
    if not ((array >= lowest) & (array <= highest)).all():
        raise refused(name, expected, array.tolist())
    return np.array(array, np.float64)


def path_text(name: str, path: Any, expected: str = "a path") -> str:
    """A path as text. The library would end it at a zero byte."""
    try:
        text = os.fspath(path)
        if not isinstance(text, str):
            raise TypeError("bytes are the content of a file")
        os.fsencode(text)
    except (TypeError, ValueError):
        raise refused(name, expected, path) from None
    if not text or "\0" in text:
        raise refused(name, f"{expected}{' without zero bytes' if text else ''}", path)
    return text
