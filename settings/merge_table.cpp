// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting parts() {
    Setting setting =
        input_file("parts", "Parts of one bake (bake --probes) that together hold all its probes");
    setting.is_list = true;
    return setting;
}

constexpr Setting kFiles[] = {parts(),
                              output_file(".probes", "Probe volume to write (- = stdout)")};

constexpr Group kGroups[] = {{"Files", kFiles}, {"Common options", kCommonSettings}};

}  // namespace

const Table kMerge{.command = "merge",
                   .summary = "Join the parts of a bake (bake --probes) in one volume",
                   .examples = "tetralight merge first.part second.part -o courtyard.probes",
                   .groups = kGroups};

}  // namespace tetralight::settings
