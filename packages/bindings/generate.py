#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the declarations of the C API for Rust (packages/rust) and C# (packages/csharp).

generate.py                  writes the files
generate.py --check          fails if a file is not what would be written
generate.py --layout FOLDER  writes programs that print the layout of every struct: in C, Rust and C#
"""
import re
import sys
from pathlib import Path

import c_header
import csharp
import rust

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ROOT / "packages"


def read_project():
    """The version of the project and that of its ABI."""
    version = re.search(r"^project\(tetralight VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(),
                        re.M)
    shared = (ROOT / "runtime/shared/CMakeLists.txt").read_text()
    abi = re.search(r"^set\(abi_version (\d+)\)$", shared, re.M)
    if not version or not abi:
        sys.exit("CMakeLists.txt: the version of the project or its ABI is missing")
    return version[1], abi[1]


def generated(header):
    version, abi = read_project()
    return {
        PACKAGES / "rust/Cargo.toml": rust.cargo(version),
        PACKAGES / "rust/src/lib.rs": rust.crate(header),
        PACKAGES / "csharp/Tetralight.cs": csharp.source(header, abi),
    }


def c_layout(header):
    lines = []
    for struct in header.structs:
        if struct.members is None:
            continue
        name = struct.name
        lines.append(f'    printf("{name} %u %u\\n", (unsigned)sizeof({name}), (unsigned)_Alignof({name}));')
        for member in struct.members:
            lines.append(f'    printf("{name}.{member.name} %u\\n", '
                         f"(unsigned)offsetof({name}, {member.name}));")
    body = "\n".join(lines)
    return ("#include <stddef.h>\n#include <stdio.h>\n\n#include <tetralight/runtime/tetralight.h>\n\n"
            f"int main(void) {{\n{body}\n    return 0;\n}}\n")


def check(files):
    for path, text in files.items():
        if not path.exists() or path.read_text() != text:
            sys.exit(f"{path.relative_to(ROOT)} is not current: run packages/bindings/generate.py")


def write(files):
    for path, text in files.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def main(arguments):
    path = ROOT / "runtime/tetralight.h"
    try:
        header = c_header.read_header(path.read_text())
    except c_header.HeaderError as error:
        sys.exit(f"{path.relative_to(ROOT)}: {error}")
    if arguments == []:
        write(generated(header))
    elif arguments == ["--check"]:
        check(generated(header))
    elif len(arguments) == 2 and arguments[0] == "--layout":
        folder = Path(arguments[1])
        write({folder / "layout.c": c_layout(header), folder / "layout.rs": rust.layout(header),
               folder / "layout.cs": csharp.layout(header)})
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
