#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Bakes all light of a scene into a folder: bake_scene.sh TETRALIGHT SCENE FOLDER [OPTION...]
# The options go to each bake (--samples 256, --sky 1, --bounces 4...).
set -euo pipefail
tetralight=$1 scene=$2 folder=$3
options=("${@:4}")
layers=(--layers sun,sky,emission) # baked apart, from the same rays
mkdir -p "$folder"

# Places, 1 m apart. A scene with probes of its own needs neither this nor --groups, --only-given-groups and --places.
"$tetralight" grid "$scene" --spacing 1 -o "$folder/places.json" --reflections "$folder/reflections.json"

# For what moves, what stands, and what shines.
"$tetralight" bake "$scene" --groups "$folder/places.json" --only-given-groups \
    -o "$folder/light.probes" "${layers[@]}" "${options[@]}"
"$tetralight" lightmap "$scene" -o "$folder/light.lightmaps" "${layers[@]}" "${options[@]}"
"$tetralight" reflect "$scene" --places "$folder/reflections.json" -o "$folder/light.ktx2" \
    "${layers[@]}" "${options[@]}"

# For engines: the scene with its lightmaps, and the three layers in one image.
"$tetralight" export "$folder/light.lightmaps" --scene "$scene" -o "$folder/lit.glb"
"$tetralight" export "$folder/light.lightmaps" --pack sun,sky,emission -o "$folder/layers.exr"

for file in light.probes light.lightmaps light.ktx2; do
    "$tetralight" validate "$folder/$file"
done
