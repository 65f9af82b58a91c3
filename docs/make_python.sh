#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# make_python.sh TETRALIGHT LIBRARY FOLDER: the picture of docs/python.md, made by the first program on that page.
set -euo pipefail
tetralight=$(realpath "$1")
export TETRALIGHT_LIBRARY
TETRALIGHT_LIBRARY=$(realpath "$2")
folder=$(realpath "$3")
project=$(realpath "$(dirname "$0")/..")
python=/usr/bin/python3  # Debian's Python has Debian's packages
[ -x "$python" ] || python=python3

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$tetralight" bake "$project/examples/scenes/courtyard.glb" -o courtyard.probes --samples 4096 --quiet
sed -n '/^```python$/,/^```$/{/^```/d;p};' "$project/docs/python.md" >all.py
sed '/^tetralight.write_png/q' all.py >first.py
PYTHONPATH=$project/packages/python/src PYTHONDONTWRITEBYTECODE=1 "$python" first.py
mv floor.png "$folder/python_floor.png"
