#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the pictures of docs/viewer.md: make_viewer_pictures.sh TETRALIGHT FOLDER. Needs the built viewer and Chromium.
set -euo pipefail
cd "$(dirname "$0")/.."
tetralight=$(realpath "$1")
mkdir -p "$2"
out=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 -B examples/scenes/make_room.py "$work/room.glb"
TETRALIGHT_COMMAND=$tetralight npm run pictures --prefix viewer --silent -- "$work/room.glb" "$work"
for picture in "$work"/viewer_*.png; do
    cwebp -quiet -q 82 -sharp_yuv "$picture" -o "$out/$(basename "$picture" .png).webp"
done
# The bake as a film: of many rounds the first four and the last.
frames=()
for name in room light; do
    mapfile -t all < <(ls -v "$work/${name}"_*.png)
    frames+=("${all[@]:0:5}" "${all[-1]}")
done
img2webp -loop 0 -lossy -q 60 -d 1500 "${frames[@]}" -o "$out/viewer_bake.webp"
