#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the pictures of docs/reflections.md: make_reflections.sh TETRALIGHT FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
tetralight=$(realpath "$1") out=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

rooms() { # SCENE [options of the script] ...
    python3 -B examples/scenes/make_reflection_rooms.py "$work/$1.glb" "${@:2}"
}
show() { # PICTURE SCENE CAMERA ...
    "$tetralight" render "$work/$2.glb" "$work/rooms.probes" -o "$out/reflection_$1.png" --camera "$3" \
        --width 560 --height 315 --exposure 0.7 --quiet "${@:4}"
}

rooms rooms
"$tetralight" bake "$work/rooms.glb" -o "$work/rooms.probes" --samples 8192 --quiet
"$tetralight" reflect "$work/rooms.glb" -o "$work/rooms.ktx2" --samples 512 --quiet
show off rooms camera
show on rooms camera --reflections "$work/rooms.ktx2"
show far rooms camera --reflections "$work/rooms.ktx2" --no-box-projection

# A mirror ball in one room, in the doorway, and in the other room.
number=0
for place in -1.2 0 1.2; do
    rooms roll --ball=$place
    show roll_$number roll camera_door --reflections "$work/rooms.ktx2"
    number=$((number + 1))
done
