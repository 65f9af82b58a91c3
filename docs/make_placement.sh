#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the pictures of docs/placement.md whose scenes are in the repository: make_placement.sh TETRALIGHT FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
tetralight=$(realpath "$1") out=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

preview() { # NAME SCENE ...
    "$tetralight" grid "$2" -o "$work/$1.json" --preview "$out/placement_$1.png" --quiet "${@:3}"
}

python3 -B examples/scenes/make_rooms.py "$work/rooms.glb"
preview room_after "$work/rooms.glb" --from=-2,1.5,0 --from 2,1.5,0 --spacing 1 --eye 0,4.6,13 --target 0,1.4,0 \
    --fov 21 --width 560 --height 245 --exposure 0.9

court=examples/scenes/courtyard.glb
preview house_after "$court" --min=-20,0,-20 --max 20,3.6,20 --spacing 1 --camera camera_interior \
    --width 560 --height 315 --exposure 1.6
above=(--eye 24,17,24 --target 0,0,0 --fov 40 --width 640 --height 360)
preview courtyard_regular "$court" --spacing 2 "${above[@]}"
preview courtyard_adaptive "$court" --mode adaptive --max-probes 1000 --target-error 1e-4 "${above[@]}"

if command -v pngquant >/dev/null; then
    for picture in "$out"/placement_*.png; do
        pngquant 256 --speed 1 --force --output "$picture" "$picture"
    done
fi
