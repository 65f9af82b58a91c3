// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    input_file("volume", "Baked probe volume (.probes)"),
    {.name = "scene",
     .type = Type::Path,
     .help = "glTF 2.0 scene that the volume was baked from (.glb or .gltf)",
     .is_required = true},
    {.name = "picture",
     .type = Type::Path,
     .help = "Write a plan and a section of the scene with a ball at each place, colored by its "
             "light through walls: grey = below 0.1 % of the mean light, orange = 1 %, red = 10 %, "
             "white = all of it",
     .extensions = ".png",
     .without = "no picture",
     .access = Access::Command}};

constexpr Setting kMeasure[] = {
    {.name = "places",
     .type = Type::Integer,
     .help = "Random places of free space to compare at",
     .unit = "places",
     .range = {1, 1'000'000},
     .default_text = "1000"},
    {.name = "samples",
     .type = Type::Integer,
     .help = "Samples of the traced light at each place",
     .unit = "samples",
     .range = {2, 1 << 24},
     .default_text = "256",
     .short_name = 's'},
    kClearance,
    {.name = "all_places",
     .type = Type::Flag,
     .help = "List all places in the JSON report, not the worst only"},
    {.name = "max_leak",
     .type = Type::Fraction,
     .help = "Fail if the mean light through walls is more than this fraction of the mean light",
     .unit = "fraction",
     .range = {0, 1, true},
     .without = "report only",
     .access = Access::Command},
    seed_setting("Seed of the places and of the traced light")};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kSceneReading.rows},
                             {"Light of the bake", kAddedLight},
                             {"Measurement", kMeasure},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kCheckLeaks{
    .command = "check-leaks",
    .summary = "Compare a volume's light with traced light: how much comes through walls",
    .examples =
        "tetralight check-leaks court.probes --scene court.glb\n"
        "tetralight check-leaks court.probes --scene court.glb --max-leak 1% "
        "--picture leaks.png",
    .groups = kGroups};

}  // namespace tetralight::settings
