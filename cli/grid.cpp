// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bake/placement/walkable.h>
#include <tetralight/bake/scene/probe_groups_gltf.h>
#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/grid_interrupt.h>
#include <tetralight/cli/grid_preview.h>
#include <tetralight/cli/grid_progress.h>
#include <tetralight/cli/grid_report.h>
#include <tetralight/cli/grid_settings.h>
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

/// The settings of a grid without a walkable surface.
Status check_without_walkable(const Values& values) {
    if (!values.is_given("agent_height")) return Ok{};
    return values.error("agent_height", "needs a walkable surface, from " +
                                            values.shown("navmesh") +
                                            " or from nodes with extras.walkable");
}

struct Grid {
    SceneOptions scene_options;
    std::string navmesh;
    std::string output;
    GridPreview preview;
    ProbeGridSettings settings;
    /// What is wrong if there is no walkable surface.
    Status without_walkable;
    CommonOptions common;

    explicit Grid(const Values& values)
        : scene_options(values),
          navmesh(values.text("navmesh")),
          output(values.text("output")),
          preview(values),
          settings(grid_settings(values)),
          without_walkable(check_without_walkable(values)),
          common(values) {
        if (output == "-" && preview.path == "-") {
            refuse(values, "preview", "stdout takes the probes already");
        }
    }

    [[nodiscard]] std::vector<std::string> inputs() const {
        std::vector<std::string> all = scene_options.inputs();
        all.push_back(navmesh);
        return all;
    }

    [[nodiscard]] Status check_files() const {
        if (auto status = check_output(output, inputs()); !status) return status;
        if (preview.path.empty()) return Ok{};
        std::vector<std::string> others = inputs();
        others.push_back(output);
        if (output != "-" && is_same_file(output, preview.path)) {
            return Error{ErrorCode::InvalidArgument, "preview", preview.path,
                         preview.path + ": is the output of this command, too"};
        }
        return check_output(preview.path, others);
    }

    Status run() {
        if (auto status = check_files(); !status) return status;
        const auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        if (auto status = find_walkable(*scene); !status) return status;
        if (auto status = preview.choose_camera(*scene, scene_options.path); !status) return status;
        const auto grid = make_grid(*scene);
        if (!grid) return located(grid.error());
        common.warn(grid_warnings(*grid, settings));
        if (grid->adaptive && grid->adaptive->end == AdaptiveEnd::Interrupted) return keep(*grid);
        if (auto status = write_groups(output, grid->groups); !status) return status;
        if (!preview.path.empty()) {
            const GridInterrupt interrupt(
                "interrupted; " + output + " is written, " + preview.path + " is as it was",
                common.is_json && output != "-");
            auto status = preview.write(*scene, *grid, common.thread_count);
            if (!status) return status;
        }
        common.report(output, grid_json(output, *grid), grid_text(output, *grid));
        return Ok{};
    }

    /// Where things move, from the file or else from the scene.
    [[nodiscard]] Status find_walkable(const Scene& scene) {
        if (navmesh.empty()) {
            settings.walkable = walkable_triangles(scene);
        } else {
            auto read = read_walkable(navmesh);
            if (!read) return read.error();
            settings.walkable = std::move(*read);
        }
        return settings.walkable.empty() ? without_walkable : Ok{};
    }

    [[nodiscard]] std::string interrupted() const {
        return "interrupted; " + output + " is as it was";
    }

    [[nodiscard]] Error located(const Error& error) const {
        if (error.code == ErrorCode::Cancelled) return Error{ErrorCode::Cancelled, interrupted()};
        return error.in(scene_options.path);
    }

    [[nodiscard]] Result<ProbeGrid> make_grid(const Scene& scene) const {
        if (settings.mode != PlacementMode::Adaptive) {
            const GridInterrupt interrupt(interrupted(), common.is_json);
            return make_probe_grid(scene, settings);
        }
        GridProgressDisplay display(common.is_quiet);
        return make_probe_grid(scene, settings, [&](const AdaptiveProgress& progress) {
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
        const std::string before = path == output ? "interrupted" : interrupted();
        const Error error{ErrorCode::Cancelled,
                          before + "; " + path + " holds the last whole result"};
        if (common.is_json) return with_report(error, grid_json(path, grid));
        common.report(path, {}, grid_text(path, grid));
        return error;
    }
};

}  // namespace

Status run_grid(const Values& values) {
    return Grid(values).run();
}

}  // namespace tetralight::cli
