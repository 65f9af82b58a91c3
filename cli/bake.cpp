// SPDX-License-Identifier: Apache-2.0
#include "base/text.h"
#include "cli/common.h"
#include "cli/group_files.h"
#include "cli/paths.h"
#include "cli/progress.h"
#include "cli/scene_options.h"
#include "pipeline/bake_volume.h"
#include "probes/probe_file.h"

namespace tetralight::cli {
namespace {

struct Bake {
    SceneOptions scene_options;
    std::vector<std::string> group_paths;
    bool only_given_groups = false;
    std::string output;
    MergeSettings merge_settings;
    BakeSettings settings;
    CommonOptions common;

    void add_to(CLI::App& command) {
        scene_options.add_to(command);
        add_output(command, output, ".probes", "Probe volume to write");
        auto* groups_option =
            add_paths(command, "-g,--groups", group_paths,
                      "Probe groups beside the scene's own: a .json file or a glTF scene; may be "
                      "given several times");
        groups_option->allow_extra_args(false);  // what follows is the next argument
        command
            .add_flag("--only-given-groups", only_given_groups,
                      "Leave the scene's own probe groups out")
            ->needs(groups_option);
        command.add_option("-s,--samples", settings.sample_count, "Directions a probe")
            ->check(CLI::Range(1u, 1u << 24))
            ->capture_default_str();
        command
            .add_option("-b,--bounces", settings.bounces,
                        "Reflections that light may take (0 = direct light only)")
            ->check(CLI::Range(0u, 1000u))
            ->capture_default_str();
        add_seed(command, settings.seed, "Seed of the random numbers");
        command
            .add_option("--weld", merge_settings.weld_tolerance,
                        "Join probes nearer than this share of the local spacing")
            ->check(numbers_in(0.0, 0.1))
            ->capture_default_str();
        common.add_to(command);
    }

    [[nodiscard]] Result<GroupFiles> all_groups(Scene& scene) const {
        auto files = GroupFiles::read(group_paths);
        if (!files || only_given_groups) return files;
        files->add(scene_options.path, std::move(scene.probe_groups));
        if (files->groups().empty()) {
            return Error{scene_options.path +
                         ": the scene has no probe groups; give some with --groups, made by "
                         "`tetralight grid` for example"};
        }
        return files;
    }

    [[nodiscard]] std::vector<std::string> inputs() const {
        std::vector<std::string> paths = group_paths;
        paths.insert(paths.end(), {scene_options.path, scene_options.sky});
        return paths;
    }

    Status run() {
        if (auto status = check_output(output, inputs()); !status) return status;
        auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        const auto files = all_groups(*scene);
        if (!files) return files.error();

        settings.thread_count = common.thread_count;
        BakeProgressDisplay display(common.is_quiet);
        const auto baked =
            bake_volume(*scene, files->groups(), merge_settings, settings,
                        [&](const BakeProgress& progress) { return display.show(progress); });
        if (!baked) return files->locate(baked.error());
        common.warn(baked->report.warnings);
        const ProbeVolumeView volume = baked->volume.view();
        if (auto status = write_probe_file(output, volume); !status) return status;
        report(volume, baked->report);
        return Ok{};
    }

    void report(const ProbeVolumeView& volume, const BakeReport& bake) const {
        const double rays_per_second = static_cast<double>(bake.ray_count) / bake.bake_seconds;
        Json json{{"output", output}};
        json.update(counts(volume));
        json.update({{"lattice_groups", bake.lattice_group_names},
                     {"largest_snap", bake.largest_snap},
                     {"samples", settings.sample_count},
                     {"bounces", settings.bounces},
                     {"rays", bake.ray_count},
                     {"rays_per_second", rays_per_second},
                     {"seconds",
                      {{"merge", bake.merge_seconds},
                       {"tetrahedralize", bake.tetrahedralize_seconds},
                       {"bake", bake.bake_seconds}}}});
        common.report(
            output, json,
            text(output, ": ", counted(volume.probe_count(), "probe"), " (",
                 merged_text(bake.welded_count, bake.lattice_group_names.size(), bake.largest_snap),
                 "), ", cells_text(volume), "\n  merge ", duration(bake.merge_seconds),
                 ", tetrahedralize ", duration(bake.tetrahedralize_seconds), ", bake ",
                 duration(bake.bake_seconds), " (", magnitude(static_cast<double>(bake.ray_count)),
                 "rays, ", magnitude(rays_per_second), "rays/s)"));
    }
};

}  // namespace

void add_bake(CLI::App& app, Run& run) {
    add_command<Bake>(app, run, "bake", "Bake a scene's light into a probe volume",
                      "tetralight bake courtyard.glb -o courtyard.probes");
}

}  // namespace tetralight::cli
