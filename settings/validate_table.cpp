// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    input_file("volume",
               "Probe volume, lightmaps or reflection probes (.probes, .lightmaps, .ktx2)"),
    {.name = "scene",
     .type = Type::Path,
     .help = "glTF 2.0 scene of the volume: also measure the free space that sees no probe of its "
             "cell",
     .without = "not measured",
     .access = Access::Command}};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kOptionalSceneReading.rows},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kValidate{.command = "validate",
                      .summary =
                          "Check a probe volume, lightmaps or reflection probes: checksums, "
                          "structure, Delaunay property",
                      .examples =
                          "tetralight validate courtyard.probes --json\n"
                          "tetralight validate courtyard.probes --scene courtyard.glb",
                      .groups = kGroups};

}  // namespace tetralight::settings
