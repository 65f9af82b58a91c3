// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    input_file("volume", "Probe volume (.probes)"),
    output_file(".vdb .nvdb .exr .dds .ktx2",
                "File to write; without an extension OpenVDB (- = stdout)"),
    {.name = "scene",
     .type = Type::Path,
     .help = "glTF 2.0 scene that has the object; points inside its geometry take light from "
             "beside it",
     .without = "no geometry"}};

constexpr Setting kGridSettings[] = {
    {.name = "object",
     .type = Type::Text,
     .help = "Node of the scene to wrap, with those of its children that ask for it",
     .without = "the box of --bounds",
     .value_name = "NAME",
     .needs = "scene"},
    {.name = "bounds",
     .type = Type::Numbers,
     .help = "World box to fill: minimum x,y,z, maximum x,y,z",
     .unit = "metres",
     .range = kPositions,
     .count = 6,
     .without = "the box of the probes",
     .value_name = "X,Y,Z,X,Y,Z",
     .excludes = "object"},
    {.name = "orientation",
     .type = Type::Numbers,
     .help = "Rotation of the --bounds about their center: a quaternion, as in glTF",
     .unit = "quaternion",
     .range = {-1e9, 1e9},
     .count = 4,
     .without = "along the world's axes",
     .value_name = "X,Y,Z,W",
     .needs = "bounds"},
    {.name = "axes",
     .type = Type::Choice,
     .help = "Axes of an object's box: its own or the world's",
     .choices = "object world",
     .default_text = "object",
     .needs = "object"},
    {.name = "resolution",
     .type = Type::Integers,
     .help = "Grid points along each axis, up to 256",
     .unit = "points",
     .range = {0, 4294967295.0},
     .count = 3,
     .without = "by --density",
     .value_name = "X,Y,Z"},
    {.name = "density",
     .type = Type::Number,
     .help = "Grid points per metre",
     .unit = "points per metre",
     .range = {1e-9, 1e9},
     .default_text = "1",
     .excludes = "resolution"},
    {.name = "placement",
     .type = Type::Choice,
     .help = "Grid points on the faces of the box, or half a spacing inside",
     .choices = "corners centers",
     .default_text = "corners"},
    {.name = "unity_limits",
     .type = Type::Flag,
     .help = "Round resolutions to powers of two up to 32, as Unity does"}};

constexpr Setting kLightSettings[] = {kRenderingLayers, kRadius};

constexpr Setting kFileSettings[] = {
    {.name = "mode",
     .type = Type::Choice,
     .help = "Bands that vary over the grid: L0 and L1 (low), these with a constant L2 (normal), "
             "all (full)",
     .choices = "low normal full",
     .default_text = "full"},
    {.name = "precision",
     .type = Type::Choice,
     .help = "Number format of the file; .nvdb files have floats",
     .choices = "half float",
     .default_text = "half"},
    {.name = "layout",
     .type = Type::Choice,
     .help = "Slabs of a texture: SHA and occlusion (four), or all bands (seven); auto = seven "
             "with --mode full",
     .choices = "auto four seven",
     .default_text = "auto"},
    {.name = "sparse",
     .type = Type::Flag,
     .help = "Write only blocks of 8x8x8 points near probes and the scene's surfaces, at "
             "--density; .vdb or .nvdb",
     .excludes = "object bounds resolution placement unity_limits mode layout"},
    {.name = "reach",
     .type = Type::Number,
     .help = "Distance from probes and surfaces within which --sparse writes blocks",
     .unit = "metres",
     .range = {0, 1e9},
     .without = "one spacing",
     .needs = "sparse"}};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kOptionalSceneReading.rows},
                             {"Grid", kGridSettings},
                             {"Light", kLightSettings},
                             {"Contents of the file", kFileSettings},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kLppv{.command = "lppv",
                  .summary = "Fill a grid around a large object with light",
                  .examples =
                      "tetralight lppv courtyard.probes --scene courtyard.glb "
                      "--object beam_long --density 2 -o beam.vdb",
                  .groups = kGroups};

}  // namespace tetralight::settings
