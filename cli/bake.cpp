// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <optional>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/bake_report.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/group_files.h>
#include <tetralight/cli/health_options.h>
#include <tetralight/cli/lighting_options.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/progress.h>
#include <tetralight/cli/scene_options.h>
#include <tetralight/pipeline/bake_chunks.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/resumable_bake.h>
#include <tetralight/pipeline/reuse_probes.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

struct Bake {
    SceneOptions scene_options;
    std::vector<std::string> group_paths;
    bool only_given_groups = false;
    std::string output;
    BakeVolumeSettings settings;
    std::optional<IndexRange> probes;
    bool is_resumed = false;
    std::string chunk_folder;
    std::string progress_file;
    std::string reuse_path;
    bool is_explained = false;
    CommonOptions common;

    void add_to(CLI::App& command) {
        scene_options.add_to(command);
        add_output(command, output, ".probes,.part", "Probe volume to write, or part of it")
            ->required(false);
        auto* groups_option =
            add_paths(command, "-g,--groups", group_paths,
                      "Probe groups beside the scene's own: a .json file or a glTF scene; may be "
                      "given several times");
        groups_option->allow_extra_args(false);  // what follows is the next argument
        command
            .add_flag("--only-given-groups", only_given_groups,
                      "Leave the scene's own probe groups out")
            ->needs(groups_option);
        command
            .add_option("-b,--bounces", settings.bake.bounces,
                        "Reflections that light may take (0 = direct light only)")
            ->check(CLI::Range(0u, 1000u))
            ->capture_default_str();
        command
            .add_option("--clamp", settings.bake.clamp,
                        "Largest radiance that a path may bring (0 = not clamped)")
            ->check(numbers_in(0.0, 1e30))
            ->capture_default_str();
        command
            .add_option("--albedo-boost", settings.bake.surfaces.albedo_boost,
                        "Raise albedo to the power of 1 / B: more light bounces (1 = as it is)")
            ->check(numbers_in(1.0, 10.0))
            ->capture_default_str();
        command
            .add_option("--max-albedo", settings.bake.surfaces.max_albedo,
                        "No surface reflects more than this")
            ->check(numbers_in(0.0, 1.0))
            ->capture_default_str();
        add_sampling(command);
        add_seed(command, settings.bake.seed, "Seed of the random numbers");
        command
            .add_option("--weld", settings.merge.weld_tolerance,
                        "Join probes nearer than this share of the local spacing: the distance to\n"
                        "the seventh nearest probe, 10 m at most")
            ->check(numbers_in(0.0, 0.1))
            ->capture_default_str();
        add_range(command, "--probes", probes,
                  "Bake this range of the probes only, into a part for `tetralight merge`");
        auto* resume = command.add_flag(
            "--resume", is_resumed, "Go on with what an interrupted bake left beside the output");
        add_path(
            command, "--chunks", chunk_folder,
            "Keep finished probes in files of this folder, each on the disk before the next is "
            "begun, and go on with those that are there")
            ->excludes(resume)
            ->excludes(command.get_option("--probes"));
        add_path(command, "--reuse", reuse_path,
                 "Bake only what changed: probes that stayed where they were take their light from "
                 "this volume; where scene or settings differ, bake all and say why")
            ->excludes(resume)
            ->excludes(command.get_option("--probes"));
        add_path(command, "--progress-file", progress_file,
                 "Say in this file how far it is, as JSON, twice a second");
        add_health_options(command, settings.health);
        add_dering_options(command, settings.dering);
        add_lighting_options(command, settings.lighting);
        command.add_flag("--explain", is_explained,
                         "Bake nothing; print what a bake takes of each light of the scene, and "
                         "what is left to the runtime");
        common.add_to(command);
        command.parse_complete_callback([this, &command] {
            check_usage();
            const auto is_told = [&](const char* option) { return command.count(option) > 0; };
            if (is_told("--samples") || is_told("--target-error") || is_told("--time-budget"))
                return;
            settings.bake = with_default_target(settings.bake);
        });
    }

    void add_sampling(CLI::App& command) {
        command
            .add_option("-s,--samples", settings.bake.sample_count,
                        "Directions a probe, 1024 at first; alone: neither more nor less")
            ->check(CLI::Range(1u, 1u << 24));
        add_share(command, "--target-error", settings.bake.target_error,
                  "Double the samples of a probe until its standard error is below this;\n"
                  "without --samples and --time-budget 0.5%, with at most 131072 samples");
        command
            .add_option("--max-samples", settings.bake.max_sample_count,
                        "Directions a probe at most then (default 64 times --samples)")
            ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 32));
        add_time(command, "--time-budget", settings.bake.time_budget_seconds,
                 "Double no samples after this time; not reproducible");
    }

    /// What no option can tell of itself.
    void check_usage() const {
        if (output.empty() && !is_explained) throw CLI::RequiredError("--output");
        const bool has_rounds =
            settings.bake.target_error > 0.0 || settings.bake.time_budget_seconds > 0.0;
        if (settings.bake.max_sample_count > 0 && !has_rounds) {
            throw CLI::ValidationError("--max-samples", "needs --target-error or --time-budget");
        }
        if (is_resumed && output == "-") {
            throw CLI::ValidationError("--resume", "nothing is left beside stdout");
        }
        const std::string extension = std::filesystem::path(output).extension().string();
        if (extension == (probes ? ".probes" : ".part")) {
            throw CLI::ValidationError(
                "--output", str_cat("with --probes a .part is written, without it .probes, not \"",
                                    output, "\""));
        }
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
        paths.insert(paths.end(),
                     {scene_options.path, scene_options.adjustments, scene_options.sky.sky});
        return paths;
    }

    Status run() { return is_explained ? run_explain() : run_bake(); }

    [[nodiscard]] Status run_explain() const {
        const auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        return explain(*scene, settings.lighting, common);
    }

    Status run_bake() {
        if (auto status = check_output(output, inputs()); !status) return status;
        if (auto status = check_kept_file(); !status) return status;
        auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        const auto files = all_groups(*scene);
        if (!files) return files.error();

        settings.bake.thread_count = common.thread_count;
        auto prepared = prepare_bake(*scene, files->groups(), settings);
        if (!prepared) return files->locate(prepared.error());
        if (reuse_path.empty()) return bake(*scene, std::move(*prepared));
        const auto old = open_probe_file(reuse_path);
        if (!old) return old.error();
        if (const Status status = reuse_probes(old->view(), *prepared); !status) {
            common.warn(
                {str_cat(reuse_path, ": nothing is re-used: ", error_text(status.error()))});
        }
        return bake(*scene, std::move(*prepared));
    }

    /// Where an interrupted bake is kept: beside the output, where there can be something.
    [[nodiscard]] std::string kept_path() const {
        std::error_code error;
        if (!chunk_folder.empty() || !reuse_path.empty()) return "";
        const auto type = std::filesystem::status(output, error).type();
        const bool is_file = type == std::filesystem::file_type::regular ||
                             type == std::filesystem::file_type::not_found;
        return output == "-" || !is_file ? "" : output + ".part";
    }

    /// Nothing but an earlier bake may be in the place of what is kept.
    [[nodiscard]] Status check_kept_file() const {
        const std::string path = kept_path();
        if (path.empty()) return Ok{};
        if (auto status = check_output(path, inputs()); !status) {
            return status.error().in("an interrupted bake would be kept there");
        }
        std::error_code error;
        if (is_resumed || !std::filesystem::exists(path, error)) return Ok{};
        const auto file = open_probe_file_lazy(path);
        if (!file || !is_part(*file)) {
            return Error{path +
                         ": is no interrupted bake and would be lost to one; move it away, or "
                         "write elsewhere"};
        }
        common.warn({path + ": an interrupted bake that --resume may go on with is lost when this "
                            "one is kept"});
        return Ok{};
    }

    [[nodiscard]] ProbeRange range_of(const PreparedBake& prepared) const {
        const auto count = static_cast<uint32_t>(prepared.capture_positions.size());
        if (!probes) return {0, count};
        return {probes->begin, probes->end == IndexRange{}.end ? count : probes->end};
    }

    /// Bakes, writes and reports, and then drops what was kept on the way.
    Status bake(const Scene& scene, PreparedBake prepared) {
        const BakeKeeping kept{kept_path(), is_resumed};
        const auto start = std::chrono::steady_clock::now();
        const auto baked = bake_with_progress(scene, prepared, kept);
        if (!baked) return baked.error();
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        if (!baked->warning.empty()) common.warn({baked->warning});
        const Status status = probes ? write_range(prepared, *baked, seconds.count())
                                     : write_whole(std::move(prepared), *baked, seconds.count());
        std::error_code error;
        if (status && baked->is_kept) std::filesystem::remove(kept.path, error);
        return status;
    }

    [[nodiscard]] Result<RangeBake> bake_with_progress(const Scene& scene,
                                                       const PreparedBake& prepared,
                                                       const BakeKeeping& kept) const {
        BakeProgressDisplay display(common.is_quiet, settings.bake.time_budget_seconds,
                                    progress_file);
        const auto show = [&](const BakeProgress& progress) { return display.show(progress); };
        const auto bake = [&](const PreparedBake& some) {
            return chunk_folder.empty() ? bake_range(scene, some, range_of(some), kept, show)
                                        : bake_in_chunks(scene, some, chunk_folder, show);
        };
        auto baked = reuse_path.empty() ? bake(prepared) : bake(bake_of_others(prepared));
        if (baked && !reuse_path.empty()) baked->partial = spread_others(prepared, baked->partial);
        if (baked || baked.error().code != ErrorCode::Cancelled) return baked;
        if (!chunk_folder.empty())
            return Error{"interrupted; " + chunk_folder + " keeps what is done"};
        if (kept.path.empty()) return Error{"interrupted"};
        return Error{"interrupted; " + kept.path + " keeps what is done, --resume goes on with it"};
    }

    Status write_range(const PreparedBake& prepared, const RangeBake& baked, double seconds) const {
        if (auto status = write_part(output, prepared, baked.partial); !status) return status;
        report_range(common, {output, settings.bake, seconds, baked.earlier_ray_count},
                     baked.partial, prepared.capture_positions.size());
        return Ok{};
    }

    Status write_whole(PreparedBake prepared, const RangeBake& baked, double seconds) const {
        const BakedVolume result =
            finish_bake(std::move(prepared), baked.partial.accumulators, baked.partial.split_rows);
        common.warn(result.report.warnings);
        if (auto status = write_probe_file(output, result.volume.view()); !status) return status;
        report_volume(common, {output, settings.bake, seconds, baked.earlier_ray_count}, result);
        return Ok{};
    }
};

}  // namespace

void add_bake(CLI::App& app, Run& run) {
    add_command<Bake>(app, run, "bake", "Bake a scene's light into a probe volume",
                      "tetralight bake courtyard.glb -o courtyard.probes");
}

}  // namespace tetralight::cli
