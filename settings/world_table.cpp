// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting output_folder() {
    Setting setting = output_file(
        "",
        "Folder of the world: an index, and a probe volume for each tile. An older world in it "
        "stays whole until the new one is complete");
    setting.value_name = "FOLDER";
    return setting;
}

constexpr Setting kFiles[] = {input_file("volume", "Probe volume to cut (.probes)"),
                              output_folder()};

constexpr Setting kTiles[] = {
    {.name = "tile",
     .type = Type::Scale,
     .help = "Sides of a tile: one number, or three along x, y and z",
     .unit = "metres",
     .range = kLengths,
     .without = "by --tile-probes",
     .excludes = "tile_probes"},
    {.name = "tile_probes",
     .type = Type::Integer,
     .help = "Cubes of about so many probes each, where probes are spread evenly",
     .unit = "probes",
     .range = {1, 4294967295.0},
     .default_text = "100000"}};

constexpr Group kGroups[] = {
    {"Files", kFiles}, {"Tiles", kTiles}, {"Common options", kCommonSettings}};

}  // namespace

const Table kWorld{.command = "world",
                   .summary = "Cut a probe volume into tiles that are opened as a camera moves",
                   .examples = "tetralight world city.probes --tile 64 -o city_world",
                   .groups = kGroups};

}  // namespace tetralight::settings
