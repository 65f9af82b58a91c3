// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    input_file("volume", "Probe volume (.probes), or folder of a world"),
    {.name = "positions",
     .type = Type::Path,
     .help = "Positions, by default x y z on each line (- = stdin)",
     .default_text = "-",
     .is_positional = true,
     .access = Access::Command},
    {.name = "output",
     .type = Type::Path,
     .help = "File for the answers (- = stdout)",
     .default_text = "-",
     .short_name = 'o',
     .access = Access::Command},
    {.name = "from",
     .type = Type::Choice,
     .help = "Format of the positions",
     .choices = "text json jsonl raw",
     .without = "by the extension (.json, .jsonl, .f32, .raw, .bin), else text",
     .access = Access::Command},
    {.name = "to",
     .type = Type::Choice,
     .help = "Format of the answers",
     .choices = "text jsonl csv raw",
     .without = "by the extension (.txt, .jsonl, .csv, .f32, .raw, .bin), else JSON lines with "
                "--json, text without",
     .access = Access::Command}};

constexpr Setting kSettings[] = {
    {.name = "outside",
     .type = Type::Choice,
     .help = "Light outside the hull of the probes: extrapolate = the hull's light carried "
             "outwards; clamp = the light of the closest point of the hull; ambient = that light, "
             "fading to the ambient light",
     .choices = "extrapolate clamp ambient",
     .default_text = "extrapolate"},
    {.name = "fade",
     .type = Type::Number,
     .help = "Distance over which --outside ambient fades",
     .unit = "metres",
     .range = kLengths,
     .default_text = "10"},
    kWalls,
    kRenderingLayers,
    kRadius,
    {.name = "normals",
     .type = Type::Flag,
     .help = "Positions lie on surfaces, and the normal of the surface follows each, x y z nx ny "
             "nz: they are pushed off along it, so that a wall takes the light of its own side",
     .access = Access::Command},
    {.name = "normal_offset",
     .type = Type::Number,
     .help = "How far positions with normals are pushed, as a share of the mean distance to the "
             "probes of their cell",
     .unit = "factor",
     .range = {0, 1000},
     .default_text = "0.1"},
    {.name = "precision",
     .type = Type::Choice,
     .help = "Read the probes as floats (full) or as their compact half-precision copies (half)",
     .choices = "full half",
     .default_text = "full"}};

constexpr Group kGroups[] = {
    {"Files", kFiles}, {"Settings", kSettings}, {"Common options", kCommonSettings}};

}  // namespace

const Table kQuery{.command = "query",
                   .summary = "Compute the light that arrives at positions",
                   .examples =
                       "echo 0 1 0 | tetralight query courtyard.probes --json\n"
                       "tetralight query courtyard.probes positions.f32 -o light.csv",
                   .groups = kGroups};

}  // namespace tetralight::settings
