// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    input_file("volume",
               "Probe volume, lightmaps, reflection probes or scene (.probes, .lightmaps, .ktx2, "
               ".glb, .gltf), or folder of a world"),
    {.name = "obj",
     .type = Type::Path,
     .help = "Also write the edges of the tetrahedra as line elements, for any viewer: Wavefront "
             "OBJ with groups `cells` and `hull` (- = stdout)",
     .extensions = ".obj",
     .without = "no file",
     .access = Access::Command},
    {.name = "ply",
     .type = Type::Path,
     .help = "The same as a PLY file with `edge` elements (- = stdout)",
     .extensions = ".ply",
     .without = "no file",
     .access = Access::Command},
    {.name = "probes",
     .type = Type::Flag,
     .help = "Also list every probe with its health: validity, standard error, distance to the "
             "nearest surface and virtual offset (metres), mean irradiance"}};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading a scene", kSceneReading.rows},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kInfo{
    .command = "info",
    .summary =
        "Describe a probe volume, lightmaps, reflection probes or a scene, or write tetrahedra as "
        "lines",
    .examples = "tetralight info courtyard.probes --obj courtyard_cells.obj",
    .groups = kGroups};

}  // namespace tetralight::settings
