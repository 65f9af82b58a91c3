// SPDX-License-Identifier: Apache-2.0
#include "bake/placement/probe_grid.h"

#include "bake/scene/probe_groups_json.h"
#include "bake/scene/read_gltf.h"
#include "base/text.h"
#include "cli/common.h"
#include "cli/paths.h"

namespace tetralight::cli {
namespace {

/// The names that `merge` takes.
CLI::Validator name_check() {
    const auto check = [](const std::string& name) -> std::string {
        if (name.empty()) return "the name is empty";
        return name.find('\n') == std::string::npos ? "" : "the name holds a line break";
    };
    return {check, ""};
}

struct Grid {
    std::string scene_path;
    std::string output;
    ProbeGridSettings settings;
    Box bounds;
    CLI::Option* low_option = nullptr;
    CommonOptions common;

    void add_to(CLI::App& command) {
        add_path(command, "SCENE", scene_path, "glTF 2.0 scene")->required();
        add_output(command, output, ".json", "Probe-group file to write");
        add_vec3_or_number(command, "--spacing", settings.spacing, "Metres between probes")
            ->required()
            ->check(numbers_in(1e-6, 1e9).description(""));
        low_option = add_vec3(command, "--min", bounds.low, "Lower corner of the box to fill");
        auto* high_option = add_vec3(command, "--max", bounds.high, "Upper corner of the box");
        low_option->needs(high_option);
        high_option->needs(low_option);
        command.add_option("--name", settings.group_name, "Name of the probe group")
            ->check(name_check())
            ->capture_default_str();
        command
            .add_option("--max-probes", settings.max_probe_count,
                        "Refuse grids with more candidates than this")
            ->check(CLI::NonNegativeNumber)
            ->capture_default_str();
        common.add_to(command);
        command.parse_complete_callback([this] { check_box(); });
    }

    void check_box() const {
        constexpr const char* kAxes[] = {"x", "y", "z"};
        for (int i = 0; i < 3; ++i) {
            if (bounds.low[i] <= bounds.high[i]) continue;
            throw CLI::ValidationError("--max", text(bounds.high[i], " is less than --min ",
                                                     bounds.low[i], " along ", kAxes[i]));
        }
    }

    Status run() {
        if (auto status = check_output(output, {scene_path}); !status) return status;
        const auto scene = read_gltf(scene_path);
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        settings.thread_count = common.thread_count;
        if (low_option->count() > 0) settings.bounds = bounds;
        const auto grid = make_probe_grid(*scene, settings);
        if (!grid) return grid.error().in(scene_path);
        auto status = write_probe_groups(output, std::span(&grid->group, 1));
        if (!status) return status;
        const size_t kept = grid->group.positions.size();
        common.report(output,
                      {{"output", output},
                       {"probes", kept},
                       {"candidates", grid->candidate_count},
                       {"inside_geometry", grid->inside_count}},
                      text(output, ": ", counted(kept, "probe"), " of ",
                           counted(grid->candidate_count, "candidate"), " (",
                           grouped(grid->inside_count), " inside geometry)"));
        return Ok{};
    }
};

}  // namespace

void add_grid(CLI::App& app, Run& run) {
    add_command<Grid>(app, run, "grid", "Fill a scene with a grid of probes",
                      "tetralight grid courtyard.glb --spacing 2 -o grid.json");
}

}  // namespace tetralight::cli
