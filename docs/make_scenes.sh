#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the picture of docs/scenes.md that begins in Blender: make_scenes.sh TETRALIGHT FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
tetralight=$(realpath "$1") out=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

blender -b --factory-startup --python-exit-code 1 --python examples/blender/make_corner.py -- "$work/corner.glb" >/dev/null
"$tetralight" bake "$work/corner.glb" -o "$work/corner.probes" --quiet
"$tetralight" lightmap "$work/corner.glb" -o "$work/corner.lightmaps" --quiet
"$tetralight" render "$work/corner.glb" "$work/corner.probes" --lightmaps "$work/corner.lightmaps" \
    -o "$out/blender_walk.png" --width 720 --height 405 --exposure 1.3 --quiet

if command -v pngquant >/dev/null; then
    pngquant 256 --speed 1 --force --output "$out/blender_walk.png" "$out/blender_walk.png"
fi
