#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# make_wheel.sh LIBRARY FOLDER: builds the wheel with libtetralight.so.0 inside, without a network, and prints
# its path. Needs python3-build, python3-setuptools and python3-wheel.
set -euo pipefail
library=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
project=$(realpath "$(dirname "$0")/../..")
python=${PYTHON:-/usr/bin/python3}  # Debian's Python has Debian's packages
[ -x "$python" ] || python=python3

# The sources are built in a copy: setuptools leaves files beside them.
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
mkdir "$copy/packages"
cp "$project/CMakeLists.txt" "$project/LICENSE" "$copy"
cp -R "$project/packages/python" "$copy/packages"
find "$copy" -name __pycache__ -prune -exec rm -rf {} +
mkdir "$copy/libraries"
cp "$library" "$copy/libraries/libtetralight.so.0"
# Highway, which chooses the vector code for the processor, is not on every machine.
highway=$(ldd "$library" | sed -n 's/.*libhwy\.so\.1 => \(\/[^ ]*\).*/\1/p')
[ -z "$highway" ] || cp -L "$highway" "$copy/libraries/libhwy.so.1"
strip --strip-unneeded "$copy"/libraries/* 2>/dev/null || true
TETRALIGHT_LIBRARY=$copy/libraries/libtetralight.so.0 "$python" -m build --no-isolation --wheel --outdir "$copy/dist" \
    "$copy/packages/python" >"$copy/log" 2>&1 || { cat "$copy/log" >&2; exit 1; }
mv "$copy"/dist/*.whl "$folder"
ls "$folder/$(basename "$(cd "$copy" && sed -n 's/^Successfully built \(.*\.whl\).*/\1/p' log | tail -1)")"
