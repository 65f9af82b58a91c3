# SPDX-License-Identifier: Apache-2.0
"""The declarations for ctypes have the layout that a C compiler gives. `tests/bindings` compares them with the
header."""
import ctypes
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import tetralight
from support import temporary_path
from tetralight import _declarations
from tetralight._library import library

PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "packages/bindings"))

import c_header  # noqa: E402
import generate  # noqa: E402
import python as ctypes_module  # noqa: E402

HEADER = c_header.read_header((PROJECT / "runtime/tetralight.h").read_text(encoding="utf-8"))


class Declarations(unittest.TestCase):
    def test_the_library_has_each_function(self):
        self.assertEqual(set(_declarations.FUNCTIONS), {function.name for function in HEADER.functions})
        for name in _declarations.FUNCTIONS:
            self.assertTrue(hasattr(library, name), name)

    def test_package_and_library_have_one_version(self):
        self.assertEqual(tetralight.__version__, generate.read_project()[0])
        self.assertEqual(_declarations.VERSION, tetralight.__version__)

    def test_structs_have_the_layout_of_the_compiler(self):
        compiler = shutil.which("cc")
        if not compiler:
            self.skipTest("a C compiler is missing")
        source, program = temporary_path("layout.c"), temporary_path("layout")
        include = Path(temporary_path("include"))
        include.mkdir()
        (include / "tetralight").symlink_to(PROJECT)
        Path(source).write_text(generate.c_layout(HEADER))
        subprocess.run([compiler, f"-I{include}", source, "-o", program], check=True)
        lines = subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()
        self.assertGreater(len(lines), 100)
        for line in lines:
            name, *numbers = line.split()
            self.assertEqual(layout_of(*name.split(".")), [int(number) for number in numbers], name)


def layout_of(struct, member=None):
    """Size and alignment of a struct, or the offset of a member."""
    kind = getattr(_declarations, ctypes_module.class_name(struct))
    if member is None:
        return [ctypes.sizeof(kind), ctypes.alignment(kind)]
    return [getattr(kind, member).offset]
