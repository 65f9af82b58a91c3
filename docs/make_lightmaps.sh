#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the pictures of docs/lightmaps.md, lit by probes alone and with lightmaps: make_lightmaps.sh TETRALIGHT FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
tetralight=$(realpath "$1") out=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

both() { # NAME SCENE VOLUME LIGHTMAPS ...
    "$tetralight" render "$2" "$3" -o "$out/$1_probes.png" --quiet "${@:5}"
    "$tetralight" render "$2" "$3" --lightmaps "$4" -o "$out/$1_maps.png" --quiet "${@:5}"
}

court=examples/scenes/courtyard.glb
"$tetralight" bake "$court" -o "$work/court.probes" --samples 4096 --quiet
"$tetralight" lightmap "$court" -o "$work/court.lightmaps" --target-error 3% --quiet
both lightmap_courtyard "$court" "$work/court.probes" "$work/court.lightmaps" --camera camera \
    --width 560 --height 315 --exposure 0.9
both lightmap_interior "$court" "$work/court.probes" "$work/court.lightmaps" --camera camera_interior \
    --width 560 --height 315 --exposure 1.6

if command -v pngquant >/dev/null; then
    for picture in "$out"/lightmap_*.png; do
        pngquant 256 --speed 1 --force --output "$picture" "$picture"
    done
fi
