// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/world.h>

#include <tetralight/base/shown_path.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/world_report.h>
#include <tetralight/pipeline/write_world.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

WorldSettings world_settings(const Values& values, const ProbeVolumeView& volume) {
    if (values.is_given("tile")) return {vec3(values, "tile")};
    return {glm::dvec3(tile_side_for(volume, values.integer("tile_probes")))};
}

}  // namespace

Status run_world(const Values& values) {
    const std::string path = values.text("volume");
    const std::string folder = values.text("output");
    const CommonOptions common(values);
    const auto file = open_probe_file(path);
    if (!file) return file.error();
    const auto summary = write_world(folder, file->view(), world_settings(values, file->view()));
    if (!summary) {
        Error error = summary.error();
        // Settings have other names here than in the library.
        if (error.field == "tile_size") error.field = "tile";
        return error.field == "output" ? error : error.in(shown_path(path));
    }
    report_world(folder, *summary, common);
    return Ok{};
}

}  // namespace tetralight::cli
