#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make_zip.py OUT.zip: the add-on as Blender installs it. The same sources give the same bytes."""
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
LICENSE = HERE.parents[1] / "LICENSE"
TIME = (1980, 1, 1, 0, 0, 0)  # the earliest of the format
KINDS = (".py", ".toml")


def add(archive, name, path):
    entry = zipfile.ZipInfo(name, TIME)
    entry.compress_type = zipfile.ZIP_DEFLATED
    entry.external_attr = 0o644 << 16
    archive.writestr(entry, path.read_bytes())


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: make_zip.py OUT.zip")
    out = Path(sys.argv[1])
    beside = out.with_name(out.name + ".new")
    with zipfile.ZipFile(beside, "w") as archive:
        for path in sorted((HERE / "tetralight").iterdir()):
            if path.suffix in KINDS:
                add(archive, f"tetralight/{path.name}", path)
        add(archive, "tetralight/LICENSE", LICENSE)
    beside.replace(out)


if __name__ == "__main__":
    main()
