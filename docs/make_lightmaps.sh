#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the pictures of docs/lightmaps.md: make_lightmaps.sh TETRALIGHT FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
tetralight=$(realpath "$1") out=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

# The courtyard, lit by probes alone and with lightmaps.
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

# The studio: one object for each thing that lightmaps do.
studio() { # SCENE [options of the script, as one word] [options of the bake] ...
    # shellcheck disable=SC2086
    python3 -B examples/scenes/make_lightmap_studio.py "$work/$1.glb" ${2:-}
    "$tetralight" bake "$work/$1.glb" -o "$work/$1.probes" --samples 2048 --quiet "${@:3}"
}
maps() { # LIGHTMAPS SCENE ... ($page: size of the pages)
    "$tetralight" lightmap "$work/$2.glb" -o "$work/$1.lightmaps" --page-size "${page:-192}" \
        --target-error 3% --quiet "${@:3}"
}
show() { # PICTURE SCENE LIGHTMAPS ... ($exposure, $width, $height)
    "$tetralight" render "$work/$2.glb" "$work/$2.probes" --lightmaps "$work/$3.lightmaps" \
        -o "$out/lightmap_$1.png" --width "${width:-400}" --height "${height:-250}" \
        --exposure "${exposure:-1}" --quiet "${@:4}"
}
preview() { # PICTURE LIGHTMAPS ...
    "$tetralight" export "$work/$2.lightmaps" --as preview -o "$out/lightmap_$1.png" --quiet "${@:3}"
}
balls=(--eye=-0.6,2.3,4.6 --target 0.05,0.25,0.95 --fov 32)
box=(--eye 2.3,1.7,1.2 --target 1.5,0.35,-1.4 --fov 30)
sphere=(--eye=-0.9,1.5,1.2 --target=-1.7,0.5,-1.7 --fov 30)
lamp=(--eye 1.6,1.3,1.7 --target 2.4,0.2,0.1 --fov 42)
leaves=(--eye 1.7,0.95,4.2 --target 1.5,0.15,2.3 --fov 34)
bricks=(--eye 0.9,1.5,0.2 --target 0.6,1.45,-3 --fov 38)
gold=(--eye=-0.9,1.5,2.9 --target=-2.1,0.25,1.2 --fov 40)

studio mixed
maps mixed mixed
show receivers mixed mixed
show receivers_texels mixed mixed --show texels
exposure=2.2 show receivers_bounce mixed mixed --show bounce "${balls[@]}"
exposure=0.6 show side_by_side mixed mixed --show received "${balls[@]}"

# What a mixed and a baked sun leave in the map.
studio baked "--sun baked"
page=512 maps mixed_20 mixed -t 20
page=512 maps baked_20 baked -t 20
show sun_mixed mixed mixed_20 "${balls[@]}"
show sun_baked baked baked_20 "${balls[@]}"
show sun_mixed_map mixed mixed_20 --show bounce "${balls[@]}"
show sun_baked_map baked baked_20 --show bounce "${balls[@]}"

# Resolution.
under_ball=(--only tile_1_0 --only tile_1_1 --only tile_2_0 --only tile_2_1 --only ball_lightmap)
above=(--eye=-1.5,2.2,2.9 --target=-0.9,0.1,1 --fov 28)
for density in 5 10 20 40; do
    page=1024 maps dense baked -t $density "${under_ball[@]}"
    exposure=0.7 show "density_$density" baked dense --show received "${above[@]}"
    show "density_${density}_texels" baked dense --show texels "${above[@]}"
done

# Pages and the rectangles of objects.
preview page_all mixed
preview page_marked mixed --mark sphere
page=128 maps small mixed
preview small small
show pages mixed small --show pages
show unwrapped_uv mixed mixed --show unwrapped-uv
show page_uv mixed mixed --show lightmap-uv
show scale mixed mixed --show texels "${lamp[@]}"

# A normal map, in the light of a sun that is drawn and of one that is baked.
studio bricks_mixed "--wall bricks"
studio bricks "--wall bricks --sun baked"
maps bricks bricks
"$tetralight" render "$work/bricks_mixed.glb" "$work/bricks_mixed.probes" -o "$out/lightmap_normal_realtime.png" \
    --width 400 --height 250 --exposure 1.15 --quiet "${bricks[@]}"
exposure=1.15 show normal_flat bricks bricks --lightmap-light flat "${bricks[@]}"
exposure=1.15 show normal_directional bricks bricks "${bricks[@]}"

# UVs of the scene that overlap.
studio overlapping "--uvs overlapping --sun baked"
maps keep overlapping --uvs keep
maps repair overlapping --uvs repair
show uvs_keep overlapping keep "${box[@]}"
show uvs_repair overlapping repair "${box[@]}"

# Seams.
studio plain "--seams plain --sun baked"
maps plain plain -t 5
maps stitched baked -t 5
maps many plain -t 5 --max-angle 12
exposure=0.7 show seams_plain plain plain --show received "${sphere[@]}"
exposure=0.7 show seams_stitched baked stitched --show received "${sphere[@]}"
exposure=0.7 show seams_many plain many --show received "${sphere[@]}"
show seams_lines baked stitched --show seams "${sphere[@]}"

# Texels inside geometry.
maps buried mixed --min-validity 0
show validity_off mixed buried "${box[@]}"
show validity_on mixed mixed "${box[@]}"
show validity mixed mixed --show validity "${box[@]}"
studio one_sided "--leaves one-sided"
page=512 maps one_sided_0 one_sided -t 20 --min-validity 0
page=512 maps one_sided one_sided -t 20
exposure=2 show leaves_off one_sided one_sided_0 --show bounce "${leaves[@]}"
exposure=2 show leaves_on one_sided one_sided --show bounce "${leaves[@]}"
exposure=2 show leaves_two_sided mixed mixed_20 --show bounce "${leaves[@]}"
show leaves_validity one_sided one_sided --show validity "${leaves[@]}"

# As stored and as decoded.
"$tetralight" export "$work/mixed.lightmaps" --as png -o "$work/rgbm.png" --quiet
python3 -B docs/split_rgbm.py "$work/rgbm.png" "$out/lightmap_rgbm_rgb.png" "$out/lightmap_rgbm_a.png"

# Parts of the light, and the sky.
exposure=0.6 show received mixed mixed --show received
show direct mixed mixed --show direct
exposure=2 show bounce mixed mixed --show bounce
show albedo mixed mixed --show albedo
exposure=0.1 show emission mixed mixed --show emission
studio night "" --sky-intensity 0
maps night mixed --sky-intensity 0
show sky_off night night

# Boosted albedo, and rough metal.
maps boosted mixed --albedo-boost 3
exposure=2 show albedo_boost mixed boosted --show bounce
studio smooth "--metal-roughness 0"
maps smooth smooth
exposure=2.5 show metal_rough mixed mixed --show bounce "${gold[@]}"
exposure=2.5 show metal_smooth smooth smooth --show bounce "${gold[@]}"

# Emission.
studio unlit "--emission none"
maps unlit unlit
show emission_none unlit unlit "${lamp[@]}"
show emission_baked mixed mixed "${lamp[@]}"
studio glow "--floor emissive --sun none" --sky-intensity 0
maps glow glow --sky-intensity 0
show emission_floor glow glow
studio glow_sun "--floor emissive"
maps glow_sun glow_sun
show emission_floor_sun glow_sun glow_sun

# Roofs.
for roof in none blend:0.3 blend:0.8 cutout; do
    studio roof "--sun baked --roof $roof"
    maps roof roof
    show "roof_${roof/:0./_}" roof roof --antialias 8
done

# Light modes and mixed lighting: each light term counts once.
cell() { width=280 height=175 show "$@" "${balls[@]}"; }
for sun in realtime mixed baked; do
    for mode in indirect shadowmask subtractive; do
        [[ $sun == mixed || $mode == indirect ]] || continue
        studio modes "--sun $sun" --mixed-lighting $mode
        page=512 maps modes modes -t 20 --mixed-lighting $mode
        cell "mode_${sun}_$mode" modes modes
        cell "mode_${sun}_${mode}_map" modes modes --show bounce
        [[ $sun != mixed || $mode != shadowmask ]] || cell mode_mask modes modes --show shadow-mask
        [[ $mode != subtractive ]] || cell shadow_color modes modes --shadow-color 0.7,0.3,0.1
    done
done

# The maps of one page, and layers as channels of one image.
studio layered "--sun mixed" --mixed-lighting shadowmask
page=256 maps layered layered --mixed-lighting shadowmask --ambient-occlusion 0.6 --layers sun,sky,emission
preview map_irradiance layered
for map in direction mono-sh shadow-mask ambient-occlusion; do preview "map_${map//-/_}" layered --map $map; done
preview pack layered --pack sun,sky,emission
for layer in sun sky emission; do preview "pack_$layer" layered --pack "$layer,$layer,$layer"; done
preview pack_variant layered --pack sky-occlusion,shadow:0,ambient-occlusion

# A lamp that is brightened after the bake.
"$tetralight" relight "$work/layered.lightmaps" -o "$work/off.lightmaps" --weights emission=0 --quiet
"$tetralight" relight "$work/layered.lightmaps" -o "$work/bright.lightmaps" --weights emission=4 --quiet
show layer_off layered off --show bounce "${lamp[@]}"
show layer_on layered layered --show bounce "${lamp[@]}"
show layer_bright layered bright --show bounce "${lamp[@]}"

# Ambient occlusion, which is wrong where light comes from near surfaces.
show ambient_occlusion layered layered --show ambient-occlusion "${lamp[@]}"
show ambient_occlusion_off layered layered "${lamp[@]}"
show ambient_occlusion_on layered layered --ambient-occlusion "${lamp[@]}"

# The filter: 64 samples without and with it, and many more samples.
noise() { # PICTURE [options of the bake] ...
    "$tetralight" lightmap "$court" -o "$work/noise.lightmaps" --quiet "${@:2}"
    "$tetralight" render "$court" "$work/court.probes" --lightmaps "$work/noise.lightmaps" --camera camera_interior \
        -o "$out/lightmap_$1.png" --show bounce --width 400 --height 250 --exposure 1.6 --quiet
}
noise raw --samples 64 --no-filter
noise filtered --samples 64
noise exact --target-error 2% --exact

if command -v pngquant >/dev/null; then
    for picture in "$out"/lightmap_*.png; do
        pngquant 256 --speed 1 --force --output "$picture" "$picture"
    done
fi
