// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    input_file("volume",
               "Probe volume, lightmaps, or reflection probes (.probes, .lightmaps, .ktx2)"),
    output_file("",
                "File to write; others of the export are put beside it, and exr and png write "
                "one file a page or cube: a_0.exr, a_1.exr"),
    {.name = "as",
     .type = Type::Choice,
     .help =
         "Format. Of lightmaps and reflection probes: exr = 32-bit float images, of a cube its six "
         "faces one below the other; ktx2 = one array texture of 16-bit floats; png = RGBM images; "
         "glb = the scene with TEXCOORD_1 and MX_lightmap, or with a reflection probe as "
         "EXT_lights_image_based; preview = PNG images for looking at, with the rectangle of each "
         "object. The others are for probe volumes: docs/engines.md has what each keeps and loses",
     .choices =
         "exr ktx2 png glb preview three-grid bevy unreal godot unity playcanvas filament babylon "
         "gltf vtu json csv blender",
     .without = "by the extension of the output"}};

constexpr Setting kVolumeSettings[] = {
    {.name = "bounds",
     .type = Type::Numbers,
     .help = "World box that a grid fills: minimum x,y,z, maximum x,y,z",
     .unit = "metres",
     .range = kPositions,
     .count = 6,
     .without = "the box of the probes",
     .value_name = "X,Y,Z,X,Y,Z",
     .access = Access::Command},
    {.name = "resolution",
     .type = Type::Integers,
     .help = "Cells of a grid along each axis",
     .unit = "cells",
     .range = {1, 2048},
     .count = 3,
     .without = "by --spacing",
     .value_name = "X,Y,Z",
     .access = Access::Command},
    {.name = "spacing",
     .type = Type::Number,
     .help = "Largest distance between the centers of a grid's cells",
     .unit = "metres",
     .range = {0, 1e9, true},
     .without = "the mean spacing of the probes",
     .excludes = "resolution",
     .access = Access::Command},
    {.name = "at",
     .type = Type::Vector,
     .help = "Place whose light is written, of formats that hold the light of places",
     .unit = "metres",
     .range = kPositions,
     .without = "every probe, or the center of the probes where a format holds one place",
     .value_name = "X,Y,Z",
     .is_list = true,
     .access = Access::Command}};

constexpr Setting kLightmapSettings[] = {
    {.name = "map",
     .type = Type::Choice,
     .help = "What is written of the texels of lightmaps: irradiance; direction = dominant "
             "direction of the "
             "light, for normal maps; mono-sh = the same with how much of the light has it; "
             "shadow-mask = how much is seen of the lights of four occlusion channels; "
             "ambient-occlusion",
     .choices = "irradiance direction mono-sh shadow-mask ambient-occlusion",
     .default_text = "irradiance"},
    {.name = "pack",
     .type = Type::Words,
     .help = "Write up to four channels of lightmaps instead: the luminance of layers by their "
             "names, light (all "
             "of it), sky-occlusion (that of layer sky over its largest value), shadow:0 to "
             "shadow:3 (of the shadow mask), ambient-occlusion; each to a power if it ends with "
             "^POWER: sun,sky,emission^0.5",
     .without = "a map",
     .value_name = "LIST"},
    {.name = "scene",
     .type = Type::Path,
     .help = "glTF 2.0 scene that the lightmaps or reflection probes were baked for",
     .without = "no scene; glb needs one"},
    {.name = "mark",
     .type = Type::Text,
     .help = "Mark the rectangles of the object of this name in the preview",
     .without = "all objects look the same",
     .value_name = "NODE",
     .is_list = true},
    {.name = "probe",
     .type = Type::Text,
     .help = "Write the reflection probe of this name, or of this number from 0, only",
     .without = "all reflection probes; in a glb the sky, or else the only one",
     .value_name = "NAME",
     .is_list = true,
     .access = Access::Command},
    {.name = "level",
     .type = Type::Integer,
     .help = "Level of the cubes that images show: 0 is a mirror's, further ones are for rougher "
             "surfaces",
     .unit = "levels",
     .range = {0, 12},
     .default_text = "0",
     .value_name = "N",
     .access = Access::Command}};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Probe volumes", kVolumeSettings},
                             {"Lightmaps and reflection probes", kLightmapSettings},
                             {"Reading the scene", kOptionalSceneReading.rows},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kExport{
    .command = "export",
    .summary =
        "Write probes for engines and tools, and lightmaps or reflection probes as images or into "
        "their scene",
    .examples =
        "tetralight export courtyard.probes --as three-grid --spacing 0.5 -o courtyard.json\n"
        "tetralight export courtyard.probes -o courtyard.vtu\n"
        "tetralight export courtyard.lightmaps -o courtyard.exr\n"
        "tetralight export courtyard.lightmaps --scene courtyard.glb -o lit.glb\n"
        "tetralight export rooms.ktx2 -o rooms.exr\n"
        "tetralight export rooms.ktx2 --scene rooms.glb --probe hall -o lit.glb",
    .groups = kGroups};

}  // namespace tetralight::settings
