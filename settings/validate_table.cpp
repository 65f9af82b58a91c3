// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {input_file("volume", "Probe volume (.probes)")};

constexpr Group kGroups[] = {{"Files", kFiles}, {"Common options", kCommonSettings}};

}  // namespace

const Table kValidate{.command = "validate",
                      .summary = "Check a probe volume: checksums, structure, Delaunay property",
                      .examples = "tetralight validate courtyard.probes --json",
                      .groups = kGroups};

}  // namespace tetralight::settings
