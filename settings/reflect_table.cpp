// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    scene_file("glTF 2.0 scene (.glb or .gltf)"),
    {.name = "output",
     .type = Type::Path,
     .help = "Reflection probes to write: a cube array of 16-bit floats (- = stdout)",
     .extensions = ".ktx2",
     .without = "none; required except with --explain",
     .short_name = 'o',
     .access = Access::Command},
    {.name = "probe",
     .type = Type::Text,
     .help = "Bake the reflection probe of this name only",
     .without = "all reflection probes of the scene",
     .value_name = "NODE",
     .is_list = true,
     .excludes = "box"},
    {.name = "places",
     .type = Type::Path,
     .help = "Bake the reflection probes of this file instead: .json or .glb, as `tetralight grid "
             "--reflections` writes them",
     .without = "the reflection probes of the scene",
     .excludes = "box",
     .access = Access::Command},
    {.name = "lightmaps",
     .type = Type::Path,
     .help =
         "Lightmaps of the scene (`tetralight lightmap`): rays end at them and take their light, "
         "which is much faster than paths",
     .without = "paths",
     .excludes = "layers",
     .access = Access::Command},
    {.name = "box",
     .type = Type::Numbers,
     .help = "Bake one reflection probe for this world box instead: minimum x,y,z, maximum x,y,z",
     .unit = "metres",
     .range = kPositions,
     .count = 6,
     .without = "the reflection probes of the scene",
     .value_name = "X,Y,Z,X,Y,Z"},
    {.name = "position",
     .type = Type::Vector,
     .help = "Where the light of the box is captured",
     .unit = "metres",
     .range = kPositions,
     .without = "the center of the box",
     .needs = "box"},
    {.name = "blend_distance",
     .type = Type::Number,
     .help = "Outside --box its reflection probe fades out over this distance",
     .unit = "metres",
     .range = {0, 1e9},
     .default_text = "0.25",
     .needs = "box"}};

constexpr Setting kCubes[] = {
    {.name = "cube_size",
     .type = Type::Integer,
     .help = "Width and height of the faces of a cube, a power of two; further levels for rougher "
             "surfaces end at 8",
     .unit = "texels",
     .range = {8, 4096},
     .default_text = "128",
     .value_name = "N"},
    {.name = "no_sky",
     .type = Type::Flag,
     .help = "Do not add the sky, which is reflected where no box is"},
    {.name = "samples",
     .type = Type::Integer,
     .help = "Paths per texel; rays with --lightmaps",
     .unit = "paths",
     .range = {1, 1 << 24},
     .without = "256; 16 with --lightmaps",
     .short_name = 's'},
    {.name = "min_validity",
     .type = Type::Number,
     .help = "Smallest fraction of rays that hit no back face; a position below it is inside "
             "geometry, and is moved out if a place is near",
     .unit = "fraction",
     .range = {0, 1},
     .default_text = "0.75"},
    seed_setting("Seed of the random numbers")};

constexpr Setting kTransport[] = {
    kBounces,
    kClamp,
    kAlbedoBoost,
    kMaxAlbedo,
    {.name = "layers",
     .type = Type::Words,
     .help = "Keep this light in separate layers, which `tetralight relight` can scale later: sun, "
             "sky, emission, light:NAME, material:NAME",
     .without = "one layer",
     .value_name = "LIST"}};

constexpr Setting kStoring[] = {
    kResume,
    kChunks,
    kStore,
    kStoreLimit,
    kProgressFile,
    {.name = "explain",
     .type = Type::Flag,
     .help = "Bake nothing; check the settings, and print what was read of the scene and what a "
             "bake takes from each of its lights",
     .access = Access::Command}};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kSceneReading.rows},
                             {"Added light", kAddedLightAlone},
                             {"Cubes", kCubes},
                             {"Light transport", kTransport},
                             {"Progress and storage", kStoring},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kReflect{.command = "reflect",
                     .summary = "Bake reflection probes: what shiny surfaces see",
                     .examples =
                         "tetralight reflect hall.glb -o hall.ktx2\n"
                         "tetralight reflect hall.glb --box=-4,0,-3,4,3,3 -o room.ktx2",
                     .groups = kGroups};

}  // namespace tetralight::settings
