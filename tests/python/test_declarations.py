# SPDX-License-Identifier: Apache-2.0
"""The declarations for ctypes are those of the C header."""
import ctypes
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from support import temporary_path
from tetralight import _declarations
from tetralight._library import library

PROJECT = Path(__file__).resolve().parents[2]
HEADER = PROJECT / "runtime/tetralight.h"
sys.path.insert(0, str(PROJECT / "packages/python"))

import make_declarations  # noqa: E402


class Declarations(unittest.TestCase):
    def test_are_those_that_the_header_gives(self):
        written = make_declarations.OUTPUT.read_text(encoding="utf-8")
        expected = make_declarations.declarations(HEADER.read_text(encoding="utf-8"))
        self.assertEqual(written, expected, "run python3 packages/python/make_declarations.py")

    def test_none_is_left_out(self):
        text = make_declarations.without_comments(HEADER.read_text(encoding="utf-8"))
        functions = text.count("TETRALIGHT_NOEXCEPT;")
        self.assertEqual(len(_declarations.FUNCTIONS), functions)
        self.assertEqual(len(make_declarations.Header(HEADER.read_text()).structs), text.count("typedef struct") - opaque(text))

    def test_the_library_has_each_function(self):
        for name in _declarations.FUNCTIONS:
            self.assertTrue(hasattr(library, name), name)

    def test_structs_have_the_layout_of_the_compiler(self):
        compiler = shutil.which("cc")
        if not compiler:
            self.skipTest("a C compiler is missing")
        header = make_declarations.Header(HEADER.read_text(encoding="utf-8"))
        source, program = temporary_path("layout.c"), temporary_path("layout")
        expected, lines = [], []
        for struct, body in header.structs:
            kind = getattr(_declarations, make_declarations.class_name(struct))
            lines.append(f'printf("%zu\\n", sizeof({struct}));')
            expected.append(ctypes.sizeof(kind))
            for member, _ in header.members(body):
                lines.append(f'printf("%zu\\n", offsetof({struct}, {member}));')
                expected.append(getattr(kind, member).offset)
        text = f'#include "{HEADER}"\n#include <stdio.h>\nint main(void) {{\n' + "\n".join(lines) + "\nreturn 0;\n}\n"
        Path(source).write_text(text)
        subprocess.run([compiler, source, "-o", program], check=True)
        output = subprocess.run([program], check=True, capture_output=True, text=True).stdout
        self.assertEqual([int(line) for line in output.split()], expected)


def opaque(text):
    """`typedef struct a a;`"""
    return len(make_declarations.re.findall(r"typedef struct (\w+) \1;", text))
