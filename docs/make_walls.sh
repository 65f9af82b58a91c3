#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the pictures of docs/walls.md, each with plain weights and with walls: make_walls.sh TETRALIGHT FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
tetralight=$(realpath "$1") out=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

both() { # NAME SCENE VOLUME ...
    "$tetralight" render "$2" "$3" -o "$out/$1_plain.png" --walls ignore --quiet "${@:4}"
    "$tetralight" render "$2" "$3" -o "$out/$1.png" --quiet "${@:4}"
}

# Two rooms, a bright one and a dim one, and a row of balls that goes through the wall.
python3 -B examples/scenes/make_rooms.py "$work/rooms.glb"
"$tetralight" grid "$work/rooms.glb" -o "$work/rooms.json" --spacing 1 --from=-2,1.5,0 --from 2,1.5,0 --quiet
"$tetralight" bake "$work/rooms.glb" -g "$work/rooms.json" -o "$work/rooms.probes" --samples 4096 --quiet
both walls_rooms "$work/rooms.glb" "$work/rooms.probes" --eye 0,4.6,13 --target 0,1.4,0 --fov 21 \
    --width 560 --height 245 --exposure 0.9

# The house of the courtyard with a regular grid up to above its roof. Cells cross its walls and its roof.
court=examples/scenes/courtyard.glb
"$tetralight" grid "$court" -o "$work/court.json" --spacing 1 --min=-20,0,-20 --max 20,5.5,20 --quiet
"$tetralight" bake "$court" -g "$work/court.json" --only-given-groups -o "$work/court.probes" --samples 2048 --quiet
both walls_courtyard "$court" "$work/court.probes" --camera camera_interior --width 560 --height 315 --exposure 1.6

if command -v pngquant >/dev/null; then
    for picture in "$out"/walls_*.png; do
        pngquant 256 --speed 1 --force --output "$picture" "$picture"
    done
fi
