// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    input_file("store", "Folder of finished probes (bake --store)"),
    {.name = "limit",
     .type = Type::Number,
     .help = "Largest size that the store may have afterwards; 0 = delete everything in it",
     .unit = "gigabytes",
     .range = {0, 1e9},
     .value_name = "GB",
     .is_required = true,
     .access = Access::Command}};

constexpr Group kGroups[] = {{"Files", kFiles}, {"Common options", kCommonSettings}};

}  // namespace

const Table kPrune{.command = "prune",
                   .summary = "Delete the least recently used probes of a store (bake --store)",
                   .examples = "tetralight prune probe-store --limit 20",
                   .groups = kGroups};

}  // namespace tetralight::settings
