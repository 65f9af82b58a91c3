# SPDX-License-Identifier: Apache-2.0
"""The C API as declarations for Python's ctypes (packages/python)."""

SCALARS = {"char": "c_char", "float": "c_float", "double": "c_double", "int32_t": "c_int32",
           "uint32_t": "c_uint32", "uint64_t": "c_uint64", "size_t": "c_size_t", "void": "None"}

HEAD = '''# SPDX-License-Identifier: Apache-2.0
"""The C API for ctypes. Written by packages/bindings/generate.py from runtime/tetralight.h: change that header."""
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
    c_void_p,
)
from typing import Any
'''

FOOT = '''}


def declare(library: ctypes.CDLL) -> None:
    """Gives the functions of a loaded library their types."""
    for name, (result, parameters) in FUNCTIONS.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = parameters
'''


def class_name(name):
    """tetralight_lppv_box -> LppvBox"""
    return "".join(word.capitalize() for word in name.split("_")[1:])


def constant(declared):
    value = declared.value.rstrip("u") if declared.value.startswith("0x") else declared.value.rstrip("uf")
    return f"{declared.name.removeprefix('TETRALIGHT_')} = {value}\n"


class Types:
    def __init__(self, header):
        self.enums = {enum.name for enum in header.enums}
        self.structs = {struct.name for struct in header.structs if struct.members is not None}

    def of(self, type_, count=0):
        """Pointers to numbers and to structs that only the library knows are addresses."""
        if type_.stars == 0 and count:
            return f"{self.of(type_)} * {count}"
        if type_.stars == 0 and type_.name in self.structs:
            return class_name(type_.name)
        if type_.stars == 0:
            return "c_int" if type_.name in self.enums else SCALARS[type_.name]
        if type_.stars == 2:
            return "POINTER(c_void_p)"
        if type_.name == "char":
            return "c_char_p"
        return f"POINTER({class_name(type_.name)})" if type_.name in self.structs else "c_void_p"


def struct(declared, types):
    members = "".join(f'        ("{member.name}", {types.of(member.type, member.count)}),\n'
                      for member in declared.members)
    return f"class {class_name(declared.name)}(Structure):\n    _fields_ = [\n{members}    ]\n"


def function(declared, types):
    parameters = ", ".join(types.of(parameter.type) for parameter in declared.parameters)
    return f'    "{declared.name}": ({types.of(declared.result)}, [{parameters}]),\n'


def module(header, version):
    types = Types(header)
    values = [*header.constants, *(value for enum in header.enums for value in enum.values)]
    structs = [struct(declared, types) for declared in header.structs if declared.members is not None]
    return (f'{HEAD}\nVERSION = "{version}"\n' + "".join(map(constant, values)) + "\n\n" + "\n\n".join(structs) +
            "\n\n# Result and parameters of each function.\nFUNCTIONS: dict[str, tuple[Any, list[Any]]] = {\n" +
            "".join(function(declared, types) for declared in header.functions) + FOOT)
