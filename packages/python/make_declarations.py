# SPDX-License-Identifier: Apache-2.0
"""Writes src/tetralight/_declarations.py, the C API for ctypes, from runtime/tetralight.h.

    python3 packages/python/make_declarations.py
"""
import re
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
HEADER = FOLDER.parents[1] / "runtime/tetralight.h"
OUTPUT = FOLDER / "src/tetralight/_declarations.py"

NUMBERS = {
    "char": "c_char",
    "double": "c_double",
    "float": "c_float",
    "int32_t": "c_int32",
    "size_t": "c_size_t",
    "uint16_t": "c_uint16",
    "uint32_t": "c_uint32",
    "uint64_t": "c_uint64",
    "uint8_t": "c_uint8",
}

HEAD = '''# SPDX-License-Identifier: Apache-2.0
"""The C API (runtime/tetralight.h) for ctypes. Written by make_declarations.py."""
from __future__ import annotations

import ctypes
from ctypes import (
    POINTER,
    Structure,
    c_char,
    c_char_p,
    c_double,
    c_float,
    c_int,
    c_int32,
    c_size_t,
    c_uint32,
    c_uint64,
    c_uint8,
    c_void_p,
)
from typing import Any
'''


def without_comments(text):
    return re.sub(r"//[^\n]*", "", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL))


def class_name(name):
    """tetralight_lppv_box -> LppvBox"""
    return "".join(word.capitalize() for word in name.split("_")[1:])


class Header:
    """The declarations of the header, in its order."""

    def __init__(self, text):
        text = without_comments(text)
        self.constants = [
            (name, value)
            for name, value in re.findall(r"#define TETRALIGHT_(\w+) (0x[0-9a-f]+|[0-9.]+)[uf]?\n", text)
        ]
        self.enums = re.findall(r"typedef enum (\w+) \{([^}]*)\}", text)
        self.structs = re.findall(r"typedef struct (\w+) \{([^}]*)\}", text)
        self.functions = re.findall(
            r"TETRALIGHT_API\s+([\w\s*]+?)\s*(\w+)\(([^)]*)\)\s*TETRALIGHT_NOEXCEPT;", text
        )

    def enumerators(self):
        for _, body in self.enums:
            yield from re.findall(r"TETRALIGHT_(\w+) = (\d+)", body)

    def type_of(self, words):
        """The ctypes type of a parameter, a result or a member: `const tetralight_volume*`."""
        name, stars = words.replace("const ", "").replace("*", "").strip(), words.count("*")
        if any(name == struct for struct, _ in self.structs):
            return f"POINTER({class_name(name)})" if stars else class_name(name)
        if any(name == enum for enum, _ in self.enums) and not stars:
            return "c_int"
        if name == "char" and stars:
            return "c_char_p"
        if stars == 0:
            return "None" if name == "void" else NUMBERS[name]
        return "POINTER(c_void_p)" if stars == 2 else "c_void_p"

    def members(self, body):
        """(name, type) of each member: `float low[3], high[3];` gives two."""
        for line in filter(None, (part.strip() for part in body.split(";"))):
            words, first, others = re.fullmatch(r"([\w\s]+?[\s*]+)(\w+(?:\[\w+\])?)((?:,.*)?)", line, re.DOTALL).groups()
            for declared in [first, *filter(None, re.split(r",\s*", others))]:
                name, count = re.fullmatch(r"(\w+)(?:\[(\w+)\])?", declared).groups()
                kind = self.type_of(" ".join(words.split()))
                yield name, f"{kind} * {count}" if count else kind

    def parameters(self, text):
        for parameter in filter(lambda words: words != "void", re.split(r",\s*", " ".join(text.split()))):
            if re.search(r"\(\*", parameter):
                yield "c_void_p"
                continue
            words, brackets = re.fullmatch(r"(.*?)\w+((?:\[\d*\])?)", parameter).groups()
            yield "c_void_p" if brackets else self.type_of(words)


def declarations(text):
    """The module's text for a header's text."""
    header = Header(text)
    lines = [HEAD]
    for name, value in [*header.constants, *header.enumerators()]:
        lines.append(f"{name} = {value}")
    lines.append("")
    for name, body in header.structs:
        lines += ["", f"class {class_name(name)}(Structure):", "    _fields_ = ["]
        lines += [f'        ("{member}", {kind}),' for member, kind in header.members(body)]
        lines += ["    ]", ""]
    lines += ["", "# Result and parameters of each function.", "FUNCTIONS: dict[str, tuple[Any, list[Any]]] = {"]
    for result, name, parameters in header.functions:
        kinds = ", ".join(header.parameters(parameters))
        lines.append(f'    "{name}": ({header.type_of(result)}, [{kinds}]),')
    lines += [
        "}",
        "",
        "",
        "def declare(library: ctypes.CDLL) -> None:",
        '    """Gives the functions of a loaded library their types."""',
        "    for name, (result, parameters) in FUNCTIONS.items():",
        "        function = getattr(library, name)",
        "        function.restype = result",
        "        function.argtypes = parameters",
        "",
    ]
    return "\n".join(lines)


if __name__ == "__main__":
    OUTPUT.write_text(declarations(HEADER.read_text(encoding="utf-8")), encoding="utf-8")
    print(OUTPUT)
