// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting groups() {
    Setting setting = input_file(
        "groups",
        "Probe groups: .json, .csv, .tscn (Godot), .unity and .prefab files, and glTF scenes");
    setting.is_list = true;
    return setting;
}

constexpr Setting kFiles[] = {
    groups(), output_file(".probes", "Probe volume to write, without light (- = stdout)")};

constexpr Setting kSettings[] = {
    kWeld,
    {.name = "backend",
     .type = Type::Choice,
     .help =
         "What tetrahedralizes: tetralight = this command itself; cgal or tetgen, as a second "
         "opinion = the program tetralight-cgal or tetralight-tetgen, found by $TETRALIGHT_CGAL "
         "or $TETRALIGHT_TETGEN, in this command's folder or in PATH. A program may take 10 "
         "minutes; sets of probes in a plane or on a line do not need it",
     .choices = "tetralight cgal tetgen",
     .default_text = "tetralight"}};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading scenes", kScenePose},
                             {"Settings", kSettings},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kTetrahedralize{.command = "tetrahedralize",
                            .summary = "Join probe groups in a volume without light",
                            .examples = "tetralight tetrahedralize grid.json -o grid.probes",
                            .groups = kGroups};

}  // namespace tetralight::settings
