#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the pictures of docs/gallery.md, docs/walls.md and some of the README: make_gallery.sh TETRALIGHT FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
tetralight=$(realpath "$1") out=$2
scene=examples/scenes/courtyard.glb
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

bake() { "$tetralight" bake --quiet "$@"; }
size=(--width 512 --height 288 --antialias 2)
render() { # NAME VOLUME ...
    "$tetralight" render "${gallery_scene:-$scene}" "$work/$2" -o "$out/$1.png" --renderer gl "${size[@]}" "${@:3}"
}
ball() { # NAME VOLUME ...
    "$tetralight" meshball "$work/$2" -o "$out/$1.png" --scene "$scene" --renderer gl "${size[@]}" \
        --specular --exposure 0.8 "${@:3}"
}

bake "$scene" -o "$work/plain.probes" --samples 4096
"$tetralight" grid "$scene" -o "$work/ball.json" --spacing 0.3 --min 4.2,0.15,-2.6 --max 8.2,3.6,1.8 --quiet
bake "$scene" -g "$work/ball.json" -o "$work/masked.probes" --samples 512 --mixed-lighting shadowmask
bake "$scene" -o "$work/layers.probes" --samples 2048 --layers sun,emission,transfer

# Inside the house, without and with probes.
render gallery_interior_off plain.probes --camera camera_interior --probes none --exposure 1.6
render gallery_interior plain.probes --camera camera_interior --exposure 1.6
# Outside: nothing has probes, still things have them, all have them.
render gallery_court_off plain.probes --camera camera --probes none --exposure 0.9
render gallery_movers_off plain.probes --camera camera --probes still --exposure 0.9
render gallery_movers plain.probes --camera camera --exposure 0.9
# Long boxes by one place each and by grids, and the points of these.
beams=(--eye 8.5,4.2,11.5 --target 1.6,1.6,0.6 --fov 46 --exposure 1.1)
render gallery_beams_one plain.probes "${beams[@]}" --probes one
render gallery_beams_lppv plain.probes "${beams[@]}"
render gallery_beams_points plain.probes "${beams[@]}" --show lppv
# The ground's green on what stands over it.
render gallery_bounce plain.probes --eye 3.4,0.35,8.6 --target 1.9,0.75,5.4 --fov 30 --exposure 1.1
# Boxes that shine, with their light in the probes and without.
glow=(--eye 8,2.4,1.5 --target 4.5,0.6,-1.2 --fov 50 --exposure 0.7)
render gallery_emission layers.probes "${glow[@]}"
python3 examples/scenes/make_courtyard.py "$work/unbaked.glb" --unbaked-emission >/dev/null
bake "$work/unbaked.glb" -o "$work/unbaked.probes" --samples 4096
gallery_scene=$work/unbaked.glb render gallery_emission_off unbaked.probes "${glow[@]}"
# A roof that lets half of the light through, and one with holes.
render gallery_roofs plain.probes --eye -13.5,4.6,9.5 --target -7,0.9,3.7 --fov 44 --exposure 0.9
# The mesh ball in three ways.
place=(--center 4.5,3,7 --radius 2.8 --eye 0,4.5,15.5 --target 4,2.6,6.5)
ball gallery_ball_probes plain.probes "${place[@]}"
ball gallery_ball_lppv plain.probes "${place[@]}" --lppv
ball gallery_ball_off plain.probes "${place[@]}" --off
# The shadow of the house on the mesh ball: from occlusion probes.
ball gallery_shadow_line masked.probes --plain --count 600 --center 6.1,1.75,-0.5 --radius 1.5 \
    --eye 6.2,1.7,7 --target 5.95,1.7,-0.5 --fov 29
# A day: one bake, another sun and another sky each.
day=(morning noon evening night)
suns=("1,-0.4,-0.5 3,1.9,1" "0.15,-1,-0.4 3.2,3,2.7" "-1,-0.3,-0.5 3.2,1.5,0.5" "0.4,-1,0.2 0.02,0.03,0.05")
skies=("0.25,0.35,0.6" "0.35,0.5,0.8" "0.3,0.22,0.3" "0.004,0.007,0.02")
for i in 0 1 2 3; do
    read -r direction irradiance <<<"${suns[i]}"
    "$tetralight" relight "$work/layers.probes" -o "$work/day.probes" --quiet --sky "${skies[i]}" \
        --sun-direction="$direction" --sun-irradiance "$irradiance"
    render "gallery_${day[i]}" day.probes --camera camera --exposure 0.9
done
# Gizmos: all cells, and one of them.
render courtyard_cells plain.probes --show cells,probes --ball-radius 0.2 --eye 12,16,25 --target 0.5,2.2,0.5 --fov 45
render gallery_selection plain.probes --show selection=0.6,1.3,6.2 --ball-radius 0.16 \
    --eye 5.5,4.2,14 --target 0.6,1.6,6.2 --fov 40 --exposure 0.9

# Where light comes through the walls of the house with few probes.
"$tetralight" grid "$scene" -o "$work/few.json" --spacing 2.6 --min -7,0.2,-6 --max 8,3.3,6 --quiet
bake "$scene" -g "$work/few.json" --only-given-groups -o "$work/few.probes" --samples 1024
"$tetralight" check-leaks "$work/few.probes" --scene "$scene" --picture "$out/check_leaks.png" --quiet

# The window of a room, and where the sun falls through it.
python3 -B examples/scenes/make_window_room.py "$work/window_room.glb"
room=("$work/window_room.glb" -g "$work/window_room.json" -o "$work/window_room.probes" --quiet)
"$tetralight" grid "${room[0]}" -o "${room[2]}" --spacing 0.5 --from 2.5,1.5,2 --min=-0.2,0,0 --max 10.2,3,4 --quiet
"$tetralight" bake "${room[@]}" --target-error 1%
"$tetralight" render "${room[0]}" "${room[4]}" -o "$out/openings.png" --show openings --camera camera --exposure 4 \
    --width 640 --height 360 --quiet

if command -v pngquant >/dev/null; then
    for picture in "$out"/gallery_*.png "$out"/courtyard_cells.png "$out"/check_leaks.png "$out"/openings.png; do
        pngquant 256 --speed 1 --force --output "$picture" "$picture"
    done
fi
