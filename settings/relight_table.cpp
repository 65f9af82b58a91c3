// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    input_file("volume", "Probe volume, lightmaps or reflection probes baked with --layers"),
    output_file(".probes .lightmaps .ktx2", "File of the same kind to write (- = stdout)")};

constexpr Setting kSettings[] = {
    {.name = "weights",
     .type = Type::Weights,
     .help = "New weights of layers, 1 = as baked; other layers are unchanged",
     .unit = "factor",
     .without = "the weights stay",
     .value_name = "LAYER=W,..."},
    sky_setting("Radiance of the sky: R,G,B or one number for a constant sky, or an "
                "equirectangular .hdr or .exr file; replaces the sky of the bake (needs layer "
                "\"transfer\")"),
    kSkyIntensity,
    kSkyRotation,
    {.name = "sun_direction",
     .type = Type::Direction,
     .help = "Move the sun, so that it shines in this direction (needs layers \"sun\" and "
             "\"transfer\")",
     .unit = "direction",
     .range = kPositions,
     .without = "as baked"},
    {.name = "sun_irradiance",
     .type = Type::Vector,
     .help = "Irradiance of the sun on a surface that faces it",
     .unit = "irradiance",
     .range = kRadiance,
     .without = "as baked",
     .value_name = "R,G,B",
     .needs = "sun_direction"},
    {.name = "blend",
     .type = Type::Path,
     .help =
         "Blend with this volume, which has the same probes, or with lightmaps of the same pages",
     .without = "no blending"},
    {.name = "blend_share",
     .type = Type::Number,
     .help = "Fraction of the light that comes from the volume of --blend",
     .unit = "fraction",
     .range = {0, 1},
     .default_text = "0.5",
     .needs = "blend"}};

constexpr Group kGroups[] = {
    {"Files", kFiles}, {"Light", kSettings}, {"Common options", kCommonSettings}};

}  // namespace

const Table kRelight{
    .command = "relight",
    .summary =
        "Change the light of probes, lightmaps or reflection probes without baking them again",
    .examples =
        "tetralight relight court.probes --weights lamp=0,neon=2 "
        "--sky dusk.exr -o night.probes\n"
        "tetralight relight court.lightmaps --weights sun=0 -o night.lightmaps\n"
        "tetralight relight court.ktx2 --weights sun=0 -o night.ktx2",
    .groups = kGroups};

}  // namespace tetralight::settings
