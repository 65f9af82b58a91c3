// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bake/scene/probe_groups_gltf.h>
#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/grid_interrupt.h>
#include <tetralight/cli/grid_options.h>
#include <tetralight/cli/grid_preview.h>
#include <tetralight/cli/grid_progress.h>
#include <tetralight/cli/grid_report.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/scene_options.h>

namespace tetralight::cli {
namespace {

Status write_groups(const std::string& path, std::span<const ProbeGroup> groups) {
    if (std::filesystem::path(path).extension() == ".glb") {
        return write_probe_groups_glb(path, groups);
    }
    return write_probe_groups(path, groups);
}

/// Where the result of a run that was cut short goes: not over a whole one.
std::string partial_path(const std::string& output) {
    std::error_code error;
    if (output == "-" || !std::filesystem::is_regular_file(output, error)) return output;
    std::filesystem::path path = output;
    return path.replace_extension(".partial" + path.extension().string()).string();
}

struct Grid {
    SceneOptions scene_options;
    std::string output;
    GridPreview preview;
    GridOptions options;
    CommonOptions common;

    void add_to(CLI::App& command) {
        scene_options.add_to(command);
        add_output(command, output, ".json,.glb", "Probe-group file to write");
        preview.add_to(command);
        options.add_to(command);
        common.add_to(command);
        command.parse_complete_callback([this] {
            options.check_usage();
            preview.view.check_usage();
            if (output == "-" && preview.path == "-") {
                throw CLI::ValidationError("--preview", "stdout takes the probes already");
            }
        });
    }

    [[nodiscard]] std::vector<std::string> inputs() const {
        return {scene_options.path, scene_options.adjustments, scene_options.sky.sky};
    }

    [[nodiscard]] Status check_files() const {
        if (auto status = check_output(output, inputs()); !status) return status;
        if (preview.path.empty()) return Ok{};
        std::vector<std::string> others = inputs();
        others.push_back(output);
        if (output != "-" && is_same_file(output, preview.path)) {
            return Error{preview.path + ": is the output of this command, too"};
        }
        return check_output(preview.path, others);
    }

    Status run() {
        if (auto status = check_files(); !status) return status;
        const auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        if (auto status = preview.choose_camera(*scene, scene_options.path); !status) return status;
        options.finish();
        options.settings.thread_count = common.thread_count;
        const auto grid = make_grid(*scene);
        if (!grid) return located(grid.error());
        common.warn(grid_warnings(*grid, options.settings));
        if (grid->adaptive && grid->adaptive->end == AdaptiveEnd::Interrupted) return keep(*grid);
        if (auto status = write_groups(output, grid->groups); !status) return status;
        if (!preview.path.empty()) {
            const GridInterrupt interrupt("interrupted; " + output + " is written, " +
                                          preview.path + " is as it was");
            auto status = preview.write(*scene, *grid, common.thread_count);
            if (!status) return status;
        }
        common.report(output, grid_json(output, *grid), grid_text(output, *grid));
        return Ok{};
    }

    [[nodiscard]] std::string interrupted() const {
        return "interrupted; " + output + " is as it was";
    }

    [[nodiscard]] Error located(const Error& error) const {
        if (error.code == ErrorCode::Cancelled) return Error{interrupted()};
        return error.in(scene_options.path);
    }

    [[nodiscard]] Result<ProbeGrid> make_grid(const Scene& scene) const {
        if (options.settings.mode != PlacementMode::Adaptive) {
            const GridInterrupt interrupt(interrupted());
            return make_probe_grid(scene, options.settings);
        }
        GridProgressDisplay display(common.is_quiet);
        return make_probe_grid(scene, options.settings, [&](const AdaptiveProgress& progress) {
            return display.show(progress);
        });
    }

    /// The last whole result of a run that was cut short.
    [[nodiscard]] Status keep(const ProbeGrid& grid) const {
        const std::string path = partial_path(output);
        if (auto status = check_output(path, inputs()); !status) {
            return status.error().in(interrupted());
        }
        if (auto status = write_groups(path, grid.groups); !status) return status;
        common.report(path, grid_json(path, grid), grid_text(path, grid));
        const std::string before = path == output ? "interrupted" : interrupted();
        return Error{before + "; " + path + " holds the last whole result"};
    }
};

}  // namespace

void add_grid(CLI::App& app, Run& run) {
    add_command<Grid>(app, run, "grid", "Fill a scene with probes",
                      "tetralight grid courtyard.glb --spacing 2 -o grid.json");
}

}  // namespace tetralight::cli
