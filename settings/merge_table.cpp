// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting parts() {
    Setting setting =
        input_file("parts",
                   "Parts of one bake that together hold all its probes (bake --probes) or texels "
                   "(lightmap --texels)");
    setting.is_list = true;
    return setting;
}

constexpr Setting kFiles[] = {
    parts(),
    {.name = "prepared",
     .type = Type::Path,
     .help = "The probes and cells of parts that were baked with --prepared",
     .without = "the parts have them",
     .access = Access::Command},
    output_file(".probes .lightmaps", "Probe volume or lightmaps to write (- = stdout)")};

constexpr Group kGroups[] = {{"Files", kFiles}, {"Common options", kCommonSettings}};

}  // namespace

const Table kMerge{.command = "merge",
                   .summary = "Join the parts of a bake in one volume, or those of lightmaps",
                   .examples =
                       "tetralight merge first.part second.part -o courtyard.probes\n"
                       "tetralight merge first.part second.part -o courtyard.lightmaps",
                   .groups = kGroups};

}  // namespace tetralight::settings
