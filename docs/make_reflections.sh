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

# A pillar behind the camera, in reflections and not in them. For all other light it is there.
small() { # PICTURE SCENE VOLUME REFLECTIONS ...
    "$tetralight" render "$work/$2.glb" "$work/$3.probes" --reflections "$work/$4.ktx2" \
        -o "$out/reflection_$1.png" --width 400 --height 225 --quiet "${@:5}"
}
reflect() { # SCENE: the cube of its left room
    "$tetralight" reflect "$work/$1.glb" --probe warm_reflections -o "$work/$1.ktx2" --samples 256 --quiet
}
rooms shown --pillar shown
rooms hidden --pillar hidden
"$tetralight" bake "$work/shown.glb" -o "$work/pillar.probes" --samples 2048 --quiet
reflect shown
reflect hidden
small pillar_shown shown pillar shown --camera camera --exposure 0.7
small pillar_hidden hidden pillar hidden --camera camera --exposure 0.7

# A ball of plastic; a chest on steel, whose light comes from probes and from lightmaps.
rooms plastic --balls plastic
small plastic plastic rooms rooms --exposure 1.3 --eye=-4.9,0.45,0.6 --target=-5.2,0.36,-0.7 --fov 22
rooms chest --chest
"$tetralight" bake "$work/chest.glb" -o "$work/chest.probes" --samples 2048 --quiet
"$tetralight" lightmap "$work/chest.glb" -o "$work/chest.lightmaps" --target-error 3% --quiet
reflect chest
chest=(--exposure 1.6 --eye=-2.2,0.45,1.6 --target=-3.4,0.2,-0.7 --fov 45)
small chest_probes chest chest chest "${chest[@]}"
small chest_lightmaps chest chest chest --lightmaps "$work/chest.lightmaps" "${chest[@]}"
