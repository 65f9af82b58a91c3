# SPDX-License-Identifier: Apache-2.0
"""Variants of the plain scene with one feature of glTF each, and their list."""
from dataclasses import dataclass

from gltf_scene import plain


@dataclass
class Variant:
    name: str
    make: object
    twin: object
    wrong: object
    expected: str  # right, told or refused
    says: str  # a part of the message that tells or refuses
    tolerance: float
    options: tuple
    or_read: bool  # instead of told, the table may have the part as read


VARIANTS = []


def variant(name, twin=plain, wrong=None, told=None, refused=None, tolerance=1e-4, options=(),
            or_read=False):
    def add(make):
        expected = "told" if told else "refused" if refused else "right"
        VARIANTS.append(Variant(name, make, twin, wrong, expected, told or refused or "", tolerance, options, or_read))
        return make
    return add


def variants(values, name, **members):
    """A variant for each of some values; `name` has {} for their words."""
    def add(make):
        for words, value in values.items():
            variant(name.format(words), **members)(lambda value=value: make(value))
        return make
    return add
