// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bake/placement/walkable.h>
#include <tetralight/bake/scene/probe_groups_gltf.h>
#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/bake/scene/reflection_places_gltf.h>
#include <tetralight/bake/scene/reflection_places_json.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/grid_interrupt.h>
#include <tetralight/cli/grid_preview.h>
#include <tetralight/cli/grid_progress.h>
#include <tetralight/cli/grid_report.h>
#include <tetralight/cli/grid_settings.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/reflection_places_report.h>
#include <tetralight/cli/scene_options.h>

namespace tetralight::cli {
namespace {

bool is_glb(const std::string& path) {
    return std::filesystem::path(path).extension() == ".glb";
}

Status write_groups(const std::string& path, std::span<const ProbeGroup> groups) {
    return is_glb(path) ? write_probe_groups_glb(path, groups) : write_probe_groups(path, groups);
}

Status write_reflections(const std::string& path, std::span<const ReflectionPlace> places) {
    return is_glb(path) ? write_reflection_places_glb(path, places)
                        : write_reflection_places_json(path, places);
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
    std::string reflections;
    GridPreview preview;
    ProbeGridSettings settings;
    /// What is wrong if there is no walkable surface.
    Status without_walkable;
    CommonOptions common;

    explicit Grid(const Values& values)
        : scene_options(values),
          navmesh(values.text("navmesh")),
          output(values.text("output")),
          reflections(values.text("reflections")),
          preview(values),
          settings(grid_settings(values)),
          without_walkable(check_without_walkable(values)),
          common(values) {
        if (output == "-" && preview.path == "-") {
            refuse(values, "preview", "stdout takes the probes already");
        }
        if (reflections == "-") refuse(values, "reflections", "is written to a file only");
    }

    [[nodiscard]] std::vector<std::string> inputs() const {
        std::vector<std::string> all = scene_options.inputs();
        all.push_back(navmesh);
        return all;
    }

    [[nodiscard]] Status check_files() const {
        if (auto status = check_output(output, inputs()); !status) return status;
        std::vector<std::string> others = inputs();
        others.push_back(output);
        if (auto status = check_other(reflections, "reflections", others); !status) return status;
        others.push_back(reflections);
        return check_other(preview.path, "preview", others);
    }

    /// Of a file beside the output, if there is one.
    [[nodiscard]] Status check_other(const std::string& path, const std::string& setting,
                                     const std::vector<std::string>& others) const {
        if (path.empty()) return Ok{};
        if (output != "-" && is_same_file(output, path)) {
            return Error{ErrorCode::InvalidArgument, setting, path,
                         path + ": is the output of this command, too"};
        }
        return check_output(path, others, setting);
    }

    Status run() {
        if (auto status = check_files(); !status) return status;
        const auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        if (auto status = find_walkable(*scene); !status) return status;
        if (auto status = preview.choose_camera(*scene, scene_options.path); !status) return status;
        const auto grid = make_grid(*scene);
        if (!grid) return located(with_size_hint(grid.error(), *scene));
        common.warn(grid_warnings(*grid, settings));
        if (grid->adaptive && grid->adaptive->end == AdaptiveEnd::Interrupted) return keep(*grid);
        if (auto status = write_groups(output, grid->groups); !status) return status;
        if (!reflections.empty()) {
            auto status = write_reflections(reflections, grid->reflection_places);
            if (!status) return status;
        }
        if (!preview.path.empty()) {
            const GridInterrupt interrupt(
                "interrupted; " + output + " is written, " + preview.path + " is as it was",
                common.is_json && output != "-");
            auto status = preview.write(*scene, *grid, common.thread_count);
            if (!status) return status;
        }
        report(*grid);
        return Ok{};
    }

    void report(const ProbeGrid& grid) const {
        Json json = grid_json(output, grid);
        std::string text = grid_text(output, grid);
        if (!reflections.empty()) {
            json["reflections"] = reflections;
            json["reflection_probes"] = reflection_places_json(grid.reflection_places);
            text += reflection_places_text(reflections, grid.reflection_places);
        }
        common.report(output, json, text);
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
