#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""version.py [X.Y.Z]: prints where the version of the project stands; with a version, writes it there.

CMakeLists.txt has the version. What is generated from it (the command, the service, packages, pkg-config, the Python
package) is not listed here; these are the files that must repeat it, because they are read without a build. A test
holds them to CMakeLists.txt (tests/packages/test_version.py).
"""
import re
import sys
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2]
NUMBER = r"\d+\.\d+\.\d+"

# (file, pattern): the one group of the pattern is the version, or a part of it by "part".
PLACES = [
    ("CMakeLists.txt", rf"^project\(tetralight VERSION ({NUMBER})", None),
    ("runtime/tetralight.h", r"^#define TETRALIGHT_VERSION_MAJOR (\d+)$", 0),
    ("runtime/tetralight.h", r"^#define TETRALIGHT_VERSION_MINOR (\d+)$", 1),
    ("runtime/tetralight.h", r"^#define TETRALIGHT_VERSION_PATCH (\d+)$", 2),
    ("runtime/tetralight.h", rf'^#define TETRALIGHT_VERSION_STRING "({NUMBER})"$', None),
    ("packages/vcpkg/tetralight/vcpkg.json", rf'^  "version": "({NUMBER})"', None),
    ("packages/blender/tetralight/__init__.py", r'^    "version": \((\d+, \d+, \d+)\)', "tuple"),
    ("packages/blender/tetralight/blender_manifest.toml", rf'^version = "({NUMBER})"$', None),
    ("packages/python/src/tetralight/_declarations.py", rf'^VERSION = "({NUMBER})"$', None),
    ("packages/rust/Cargo.toml", rf'^version = "({NUMBER})"$', None),
    ("packages/js/README.md", rf"npm pack +# tetralight-({NUMBER})\.tgz", None),
    ("packages/js/README.md", rf"packages/js/tetralight-({NUMBER})\.tgz$", None),
]
for folder in ("packages/js", "viewer"):
    PLACES.append((f"{folder}/package.json", rf'\A\{{\n  "name": "[^"]*",\n  "version": "({NUMBER})"', None))
    PLACES.append((f"{folder}/package-lock.json", rf'\A\{{\n  "name": "[^"]*",\n  "version": "({NUMBER})"', None))
    PLACES.append((f"{folder}/package-lock.json", rf'"": \{{\n      "name": "[^"]*",\n      "version": "({NUMBER})"', None))


def written(version, part):
    """A version as a place has it."""
    numbers = version.split(".")
    return ", ".join(numbers) if part == "tuple" else version if part is None else numbers[part]


def find(path, pattern):
    found = list(re.finditer(pattern, (SOURCES / path).read_text(), re.M))
    if len(found) != 1:
        sys.exit(f"{path}: {len(found)} places match {pattern}; exactly one is needed")
    return found[0]


def current():
    path, pattern, _ = PLACES[0]
    return find(path, pattern)[1]


def differing():
    """The places that do not have the version of CMakeLists.txt, as text."""
    version = current()
    return [f"{path}: {find(path, pattern)[1]} instead of {written(version, part)}"
            for path, pattern, part in PLACES if find(path, pattern)[1] != written(version, part)]


def write(version):
    for path, pattern, part in PLACES:
        match = find(path, pattern)
        text = match.string[:match.start(1)] + written(version, part) + match.string[match.end(1):]
        (SOURCES / path).write_text(text)


def main():
    if len(sys.argv) > 2 or (len(sys.argv) == 2 and not re.fullmatch(NUMBER, sys.argv[1])):
        sys.exit("usage: version.py [X.Y.Z]")
    if len(sys.argv) == 2:
        write(sys.argv[1])
    print(current(), *differing(), sep="\n")


if __name__ == "__main__":
    main()
