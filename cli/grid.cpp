// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "bake/placement/probe_grid.h"
#include "bake/scene/probe_groups_gltf.h"
#include "bake/scene/probe_groups_json.h"
#include "cli/common.h"
#include "cli/grid_options.h"
#include "cli/grid_preview.h"
#include "cli/grid_progress.h"
#include "cli/grid_report.h"
#include "cli/paths.h"
#include "cli/scene_options.h"

namespace tetralight::cli {
namespace {

Status write_groups(const std::string& path, std::span<const ProbeGroup> groups) {
    if (std::filesystem::path(path).extension() == ".glb") {
        return write_probe_groups_glb(path, groups);
    }
    return write_probe_groups(path, groups);
}

struct Grid {
    SceneOptions scene_options;
    std::string output;
    std::string preview;
    GridOptions options;
    CommonOptions common;

    void add_to(CLI::App& command) {
        scene_options.add_to(command);
        add_output(command, output, ".json,.glb", "Probe-group file to write");
        add_file_to_write(command, "--preview", preview, ".png",
                          "Picture to write of the scene with the probes, lit by a quick bake");
        options.add_to(command);
        common.add_to(command);
        command.parse_complete_callback([this] { options.check_usage(); });
    }

    Status run() {
        const std::string& path = scene_options.path;
        std::vector<std::string> inputs{path, scene_options.adjustments, scene_options.sky.sky};
        if (auto status = check_output(output, inputs); !status) return status;
        if (!preview.empty()) {
            inputs.push_back(output);
            auto status = check_output(preview, inputs);
            if (!status) return status;
        }
        const auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        options.finish();
        options.settings.thread_count = common.thread_count;
        const auto grid = make_grid(*scene);
        if (!grid) return grid.error().in(path);
        if (auto status = write_groups(output, grid->groups); !status) return status;
        if (!preview.empty()) {
            auto status = write_preview(preview, *scene, *grid, common.thread_count);
            if (!status) return status;
        }
        common.warn(grid_warnings(*grid));
        common.report(output, grid_json(output, *grid), grid_text(output, *grid));
        if (!grid->adaptive || grid->adaptive->end != AdaptiveEnd::Interrupted) return Ok{};
        return Error{"interrupted; " + output + " holds the last whole result"};
    }

    [[nodiscard]] Result<ProbeGrid> make_grid(const Scene& scene) const {
        if (options.settings.mode != PlacementMode::Adaptive) {
            return make_probe_grid(scene, options.settings);
        }
        GridProgressDisplay display(common.is_quiet);
        return make_probe_grid(scene, options.settings, [&](const AdaptiveProgress& progress) {
            return display.show(progress);
        });
    }
};

}  // namespace

void add_grid(CLI::App& app, Run& run) {
    add_command<Grid>(app, run, "grid", "Fill a scene with probes",
                      "tetralight grid courtyard.glb --spacing 2 -o grid.json");
}

}  // namespace tetralight::cli
