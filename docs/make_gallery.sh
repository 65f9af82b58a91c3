#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the pictures of docs/gallery.md and some of docs/walls.md, docs/bake.md and docs/scenes.md:
#   make_gallery.sh TETRALIGHT FOLDER [--keep WORK] [--sponza SPONZA.glb]
# --keep: folder of the bakes and of the pictures as PNG; the next run makes only what is missing in it.
# --sponza: the pictures of that scene too.
# shellcheck disable=SC2054  # values of options have commas
set -euo pipefail
cd "$(dirname "$0")/.."
tetralight=$(realpath "$1") out=$2
shift 2
sponza="" work=""
while (($# > 1)); do
    case $1 in
        --sponza) sponza=$2 ;;
        --keep) work=$2 ;;
        *) echo "make_gallery.sh: unknown option $1" >&2 && exit 2 ;;
    esac
    shift 2
done
if [[ -z $work ]]; then
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
fi
mkdir -p "$out" "$work"
command -v cwebp >/dev/null || { echo "make_gallery.sh: needs cwebp (Debian: apt-get install webp)" >&2; exit 1; }

once() { # FILE COMMAND ...: runs the command unless the file is there
    [[ -e $1 ]] || "${@:2}"
}
bake() { once "$work/$1" "$tetralight" "$2" "$3" -o "$work/$1" --quiet "${@:4}"; } # FILE COMMAND SCENE ...
webp() { cwebp -quiet -q "${quality:-88}" -sharp_yuv "$work/$1.png" -o "$out/$1.webp"; }
show() { # PICTURE SCENE VOLUME ...   ($width and $height)
    once "$work/$1.png" "$tetralight" render "$work/$2.glb" "$work/$3.probes" -o "$work/$1.png" \
        --width "${width:-960}" --height "${height:-540}" --antialias 4 --quiet "${@:4}"
    webp "$1"
}
small() { width=640 height=360 show "$@"; }

# The room: one bake with layers for all its lights.
python3 -B examples/scenes/make_room.py "$work/room.glb"
python3 -B examples/scenes/make_room.py "$work/screen.glb" --screen
layers=(--layers sun,sky,material:shade,material:bulb_pendant,light:floor_lamp_light,light:pendant_light)
inside=(--min 0,0,-1.42 --max 6,2.7,4.6 --from 2,1.5,2.8)
bake room.json grid "$work/room.glb" --spacing 0.4 "${inside[@]}"
bake room.probes bake "$work/room.glb" -g "$work/room.json" --samples 4096 "${layers[@]}" --mixed-lighting shadowmask
bake room.lightmaps lightmap "$work/room.glb" -t 20 --samples 96 "${layers[@]}" --mixed-lighting shadowmask
bake room.ktx2 reflect "$work/room.glb" --cube-size 128 --samples 64 --clamp 20 "${layers[@]}" --resume

lamps_off=material:shade=0,material:bulb_pendant=0,light:floor_lamp_light=0,light:pendant_light=0
declare -A weights=([day]=$lamps_off [clouds]=sun=0,$lamps_off [evening]=sun=0,sky=0.05
    [night]=sun=0,sky=0.004,material:bulb_pendant=0,light:pendant_light=0)
for time in day clouds evening night; do
    for kind in probes lightmaps ktx2; do
        once "$work/$time.$kind" "$tetralight" relight "$work/room.$kind" -o "$work/$time.$kind" \
            --weights "${weights[$time]}" --quiet
    done
done
all() { echo --lightmaps "$work/$1.lightmaps" --reflections "$work/$1.ktx2"; }
day=(--exposure 8) evening=(--exposure 6.5)

# shellcheck disable=SC2046  # all prints options
{
    show gallery_day room day --camera camera $(all day) "${day[@]}"
    show gallery_evening room evening --camera camera $(all evening) "${evening[@]}"
    small gallery_clouds room clouds --camera camera $(all clouds) --exposure 18
    small gallery_night room night --camera camera $(all night) --exposure 7
    small gallery_noon room day --camera camera_windows $(all day) --exposure 6
    small gallery_lamps room evening --camera camera_windows $(all evening) "${evening[@]}"

    # What moves: without light from probes, and with it.
    moving=(--camera camera "${day[@]}")
    small gallery_direct room day "${moving[@]}" --probes none
    small gallery_still room day "${moving[@]}" --lightmaps "$work/day.lightmaps" --probes still
    small gallery_moving room day "${moving[@]}" $(all day)

    # Surfaces: probes alone, and lightmaps.
    surfaces=(--camera camera_table --exposure 20)
    small gallery_surfaces_probes room clouds "${surfaces[@]}"
    small gallery_surfaces_lightmaps room clouds "${surfaces[@]}" --lightmaps "$work/clouds.lightmaps"

    # Reflections.
    shiny=(--eye 2.75,0.62,3.75 --target 2.7,0.32,2.1 --fov 42 --exposure 5.5)
    small gallery_reflections_off room day "${shiny[@]}" --lightmaps "$work/day.lightmaps"
    small gallery_reflections_on room day "${shiny[@]}" $(all day)
}

# Walls: probes 1 m apart, in the evening, seen from the dim corridor.
bake coarse.json grid "$work/room.glb" --spacing 1 "${inside[@]}"
bake coarse.probes bake "$work/room.glb" -g "$work/coarse.json" --samples 8192 "${layers[@]}"
once "$work/evening_coarse.probes" "$tetralight" relight "$work/coarse.probes" -o "$work/evening_coarse.probes" \
    --weights "${weights[evening]}" --quiet
corridor=(--camera camera_corridor --exposure 28)
small gallery_walls_plain room evening_coarse "${corridor[@]}" --walls ignore
small gallery_walls room evening_coarse "${corridor[@]}"

# A folding screen that moves: by one place, and by a grid.
screen=(--eye 4.7,1.45,1.7 --target 1.95,0.95,4.0 --fov 46 "${evening[@]}")
small gallery_screen_one screen evening "${screen[@]}" --probes one
small gallery_screen screen evening "${screen[@]}"
small gallery_screen_points screen evening "${screen[@]}" --show lppv

# The mesh ball, in three ways and large.
ball() { # PICTURE WIDTH HEIGHT ...
    once "$work/$1.png" "$tetralight" meshball "$work/evening.probes" --scene "$work/room.glb" --lightmaps "$work/evening.lightmaps" \
        --reflections "$work/evening.ktx2" -o "$work/$1.png" --width "$2" --height "$3" --specular --quiet \
        --center 3.3,1.3,1.9 --radius 0.85 --eye 4.9,1.5,4.35 --target 2.9,1.12,1.2 --fov 50 "${evening[@]}" "${@:4}"
    webp "$1"
}
ball gallery_ball_off 640 360 --antialias 4 --off
ball gallery_ball_probes 640 360 --antialias 4
ball gallery_ball_lppv 640 360 --antialias 4 --lppv
quality=84 ball gallery_ball 1920 1080 --antialias 4

# The probes.
small gallery_probes room evening --camera camera "${evening[@]}" --show probes --ball-radius 0.04

if [[ -n $sponza ]]; then
    ln -sf "$(realpath "$sponza")" "$work/sponza.glb"
    sun=(--sun-direction 0.12,-1,0.2 --sun-irradiance 12,11,9.5 --sun-angle 0.53 --sky 0.9,1.1,1.45)
    bake sponza.json grid "$sponza" --spacing 1.6 "${sun[@]}"
    bake sponza.probes bake "$sponza" -g "$work/sponza.json" --samples 384 "${sun[@]}" --mixed-lighting shadowmask
    bake sponza.lightmaps lightmap "$sponza" -t 7 --samples 64 "${sun[@]}" --mixed-lighting shadowmask
    sponza() { # PICTURE CAMERA EXPOSURE
        small "gallery_sponza_$1_direct" sponza sponza --camera "$2" --exposure "$3" --probes none
        small "gallery_sponza_$1_probes" sponza sponza --camera "$2" --exposure "$3"
        small "gallery_sponza_$1" sponza sponza --camera "$2" --exposure "$3" --lightmaps "$work/sponza.lightmaps"
    }
    sponza court CameraAlternate 2
    sponza arcade CameraAlcove 16
fi

# Pictures of other pages. The cells of the courtyard; where light comes through its walls with few probes.
court=examples/scenes/courtyard.glb
bake court.probes bake "$court" --samples 4096
"$tetralight" render "$court" "$work/court.probes" -o "$out/courtyard_cells.png" --width 512 --height 288 \
    --show cells,probes --ball-radius 0.2 --eye 12,16,25 --target 0.5,2.2,0.5 --fov 45 --quiet
bake few.json grid "$court" --spacing 2.6 --min -7,0.2,-6 --max 8,3.3,6
bake few.probes bake "$court" -g "$work/few.json" --only-given-groups --samples 1024
"$tetralight" check-leaks "$work/few.probes" --scene "$court" --picture "$out/check_leaks.png" --quiet

# The window of a room, and where the sun falls through it.
python3 -B examples/scenes/make_window_room.py "$work/window_room.glb"
bake window_room.json grid "$work/window_room.glb" --spacing 0.5 --from 2.5,1.5,2 --min=-0.2,0,0 --max 10.2,3,4
bake window_room.probes bake "$work/window_room.glb" -g "$work/window_room.json" --target-error 1%
"$tetralight" render "$work/window_room.glb" "$work/window_room.probes" -o "$out/openings.png" --show openings \
    --camera camera --exposure 4 --width 640 --height 360 --quiet

if command -v pngquant >/dev/null; then
    for picture in "$out"/{courtyard_cells,check_leaks,openings}.png; do
        pngquant 256 --speed 1 --force --output "$picture" "$picture"
    done
fi
