// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/make_plan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include <tetralight/base/file.h>
#include <tetralight/base/hex.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/bake_inputs.h>
#include <tetralight/cli/earlier_light.h>
#include <tetralight/cli/interrupt.h>
#include <tetralight/cli/lightmap_settings.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/reflect_inputs.h>
#include <tetralight/cli/reflection_places_report.h>
#include <tetralight/cli/submit_slurm.h>
#include <tetralight/cli/task_record.h>
#include <tetralight/pipeline/bake_key.h>
#include <tetralight/pipeline/estimate_bytes.h>
#include <tetralight/pipeline/estimate_rays.h>
#include <tetralight/pipeline/partial_bake.h>
#include <tetralight/probes/content_hash.h>
#include <tetralight/settings/read_values.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

/// Rays of one path of a cube, if nothing was measured.
constexpr double kRaysPerPath = 4.0;
/// Of a processor, if nothing was measured.
constexpr double kRaysPerSecond = 1e6;
/// Share of a bake of lightmaps that makes its radiance cache.
constexpr double kCacheShare = 0.1;
/// In the name of the part that the task of the cache writes, and nothing joins.
constexpr const char* kCachePart = "cache";

std::string key_of(const std::string& text) {
    ContentHash hash;
    hash.add_bytes(std::as_bytes(std::span(text)));
    return hex(hash.value());
}

/// Of its bytes; empty if it cannot be read.
std::string key_of_file(const std::string& path) {
    const auto bytes =
        path.empty() ? Result<std::vector<std::byte>>(std::vector<std::byte>()) : read_file(path);
    return bytes ? key_of({reinterpret_cast<const char*>(bytes->data()), bytes->size()}) : "";
}

/// A task of a scene before all tasks are numbered.
struct SceneTask {
    size_t phase = 0;
    PlanTask task;
};

/// A result and its tasks.
struct Piece {
    PlanResult result;
    std::vector<SceneTask> tasks;
};

class Planner {
  public:
    explicit Planner(const PlanSettings& settings) : settings_(settings) {}

    Result<PlanFile> run(std::span<const SceneOrder> orders) {
        if (auto status = check_slurm_is_done(settings_.job); !status) return status.error();
        if (auto status = make_folders(); !status) return status.error();
        if (auto status = read_old_plan(); !status) return status.error();
        for (const SceneOrder& order : orders) {
            const std::array steps{&Planner::add_probes, &Planner::add_lightmaps,
                                   &Planner::add_reflections};
            scenes_.push_back({order.name, order.limits, leak_check_of(order)});
            for (const auto step : steps) {
                if (Interrupt::signal() != 0) return Error{ErrorCode::Cancelled, "interrupted"};
                if (auto status = (this->*step)(order); !status) return status.error();
            }
        }
        if (pieces_.empty()) {
            return Error{ErrorCode::NotFound, "order", "",
                         "there is nothing to bake: no scene has probe groups, objects with "
                         "lightmaps or reflection probes"};
        }
        const PlanFile plan = numbered();
        if (auto status = write_plan(settings_.job, plan); !status) return status.error();
        warn_of_lost_tasks(plan);
        remove_other_results(settings_.job, plan);
        return plan;
    }

  private:
    void warn_of_lost_tasks(const PlanFile& plan) const {
        std::set<std::string> keys;
        for (const PlanTask& task : plan.tasks) keys.insert(task.key);
        size_t lost = 0;
        for (size_t i = 0; i < old_.tasks.size(); ++i)
            lost += !keys.contains(old_.tasks[i].key) && find_record(settings_.job, old_, i);
        if (lost == 0) return;
        settings_.common.warn(
            {str_cat(settings_.job, ": removed the results of ", counted(lost, "finished task"),
                     " that the new plan does not have")});
    }

    [[nodiscard]] Status make_folders() const {
        for (const char* name : {"prepared", "parts", "done"}) {
            if (auto status = make_folder(in_job(name), "output"); !status) return status;
        }
        return Ok{};
    }

    Status read_old_plan() {
        auto old = read_plan(settings_.job);
        if (old) old_ = std::move(*old);
        const bool is_new = !old && old.error().code == ErrorCode::NotFound;
        return old || is_new ? Status(Ok{}) : Status(old.error());
    }

    /// The settings of one kind of an order, checked together.
    [[nodiscard]] static Result<Values> values_of(const SceneOrder& order,
                                                  const settings::Table& table, const Json& json) {
        auto values = settings::values_from_json(table, json, settings::Access::Command);
        if (!values) return order.is_by_scene ? values.error().in(order.place) : values.error();
        values->set(*table.find("quiet"), true);
        return values;
    }

    /// Calls `work`; a usage error is one of the order. Errors name the place in the order.
    template <class Work>
    static Status guarded(const SceneOrder& order, const char* kind, const Work& work) {
        Status status = Ok{};
        try {
            status = work();
        } catch (const UsageError& usage) {
            status = order.is_by_scene ? usage.error.in(order.place) : usage.error;
        }
        if (status || order.is_by_scene || status.error().code == ErrorCode::Cancelled)
            return status;
        return status.error().in(str_cat(order.place, ".", kind));
    }

    Status add_probes(const SceneOrder& order) {
        if (!order.probes) return Ok{};
        return guarded(order, "probes", [&]() -> Status {
            const auto values = values_of(order, settings::kBake, *order.probes);
            if (!values) return values.error();
            BakeInputs inputs(*values);
            inputs.settings.bake.thread_count = settings_.common.thread_count;
            auto scene = inputs.scene_options.read();
            if (!scene) return scene.error();
            settings_.common.warn(scene->warnings);
            if (order.is_by_scene && scene->probe_groups.empty()) {
                settings_.common.warn({str_cat(order.place,
                                               ": has no probe groups (`tetralight "
                                               "grid` makes them): no probes")});
                return Ok{};
            }
            GroupFiles files;
            const auto prepared = inputs.prepare(*scene, files);
            if (!prepared) return prepared.error();
            settings_.common.warn(files.warnings());
            settings_.common.warn(files.locate(prepared->report.warnings));
            return plan_probes(order, *scene, *prepared);
        });
    }

    Status plan_probes(const SceneOrder& order, const Scene& scene, const PreparedBake& prepared) {
        const std::string path = str_cat("prepared/", order.name, ".probes");
        Piece piece{result_of(order, "probes", ".probes", hex(prepared.key)), {}};
        piece.result.command = {{"command", "merge"}, {"prepared", path}};
        const auto is_relit = relights(
            scene, prepared.settings.lighting, [&] { return content_without_lamps(prepared); },
            piece);
        if (!is_relit) return is_relit.error();
        if (*is_relit) return Ok{};
        if (!keep_tasks(piece)) {
            piece.result.bytes = estimate_bytes(prepared);
            if (auto status = write_prepared_bake(in_job(path), prepared); !status) return status;
            const auto estimate =
                estimate_rays(scene, {prepared.capture_positions}, prepared.settings.bake,
                              prepared.volume.occlusion_lights, watch_signals);
            if (!estimate) return estimate.error();
            Json command = command_of("bake", *order.probes);
            command["prepared"] = path;
            command["resume"] = true;
            reuse_earlier(order, command);
            add_ranges(*estimate, {"probes", "probes", prepared.capture_positions.size()}, command,
                       0, piece);
        }
        add_parts(piece);
        pieces_.push_back(std::move(piece));
        return Ok{};
    }

    /// All that probes depend on beside their scene.
    [[nodiscard]] static std::string content_without_lamps(PreparedBake prepared) {
        prepared.volume.metadata.clear();  // it has the key of the scene
        for (Light& light : prepared.volume.lights) light.intensity = glm::vec3(0.0f);
        return hex(bake_key(prepared));
    }

    /// Adds a piece without tasks if only lamps of layers of their own changed their strength.
    /// `content`: gives what the result depends on beside the scene (`lamps_json`).
    template <class Content>
    Result<bool> relights(const Scene& scene, const LightingSettings& lighting,
                          const Content& content, Piece& piece) {
        if (settings_.earlier_folder.empty() || lighting.layers.empty()) return false;
        const auto lamps = lamp_strengths(scene, lighting);
        if (!lamps) return lamps.error();
        if (lamps->strengths.empty()) return false;
        piece.result.lamps = lamps_json(*lamps, content());
        const auto is_relit =
            take_earlier_light(settings_.job, settings_.earlier_folder, piece.result);
        if (!is_relit) return is_relit.error();
        if (*is_relit || keep_relit(piece)) {
            pieces_.push_back(std::move(piece));
            return true;
        }
        return false;
    }

    /// Takes the result of the old plan if it is the same, and was relit.
    bool keep_relit(Piece& piece) const {
        const PlanResult* same = same_result(piece.result);
        if (same == nullptr || same->command.value("command", "") != "relight") return false;
        std::error_code ignored;
        if (!fs::is_regular_file(in_job(same->command.value("volume", "")), ignored)) return false;
        piece.result = *same;
        return true;
    }

    /// Of the old plan; null if it has no such result.
    [[nodiscard]] const PlanResult* same_result(const PlanResult& now) const {
        const auto same = std::ranges::find_if(old_.results, [&](const PlanResult& old) {
            return old.scene == now.scene && old.kind == now.kind && old.key == now.key;
        });
        return same == old_.results.end() ? nullptr : &*same;
    }

    /// Probes that did not change take their light from the earlier result.
    void reuse_earlier(const SceneOrder& order, Json& command) const {
        if (settings_.earlier_folder.empty() || command.contains("reuse")) return;
        const bool is_relit = std::ranges::any_of(old_.results, [&](const PlanResult& old) {
            return old.scene == order.name && old.kind == "probes" &&
                   old.command.value("command", "") == "relight";
        });
        if (is_relit) return;
        const fs::path earlier =
            fs::absolute(fs::path(settings_.earlier_folder) / (order.name + ".probes"));
        std::error_code ignored;
        if (fs::is_regular_file(earlier, ignored)) command["reuse"] = earlier.string();
    }

    /// Reads the scene as the bake of its probes does.
    [[nodiscard]] static Json leak_check_of(const SceneOrder& order) {
        if (!order.probes || !order.limits.contains("leak")) return Json::object();
        constexpr std::array own{"places", "samples", "clearance", "seed"};
        Json check{{"command", "check-leaks"}};
        for (const auto& [name, value] : order.probes->items()) {
            const bool is_of_scene = std::ranges::find(own, name) == own.end();
            if (is_of_scene && settings::kCheckLeaks.find(name) != nullptr) check[name] = value;
        }
        return check;
    }

    Status add_lightmaps(const SceneOrder& order) {
        if (!order.lightmaps) return Ok{};
        return guarded(order, "lightmaps", [&]() -> Status {
            const auto values = values_of(order, settings::kLightmap, *order.lightmaps);
            if (!values) return values.error();
            const SceneOptions options(*values);
            BakeLightmapsSettings asked = lightmap_settings(*values);
            asked.bake.thread_count = asked.layout.thread_count = asked.texels.thread_count =
                settings_.common.thread_count;
            const auto scene =
                options.read(asked.has_normal_maps ? NormalMaps::Read : NormalMaps::Skip);
            if (!scene) return scene.error();
            if (order.is_by_scene && std::ranges::none_of(scene->instances, [](const auto& one) {
                    return one.contributes_gi;
                }))
                return Ok{};
            const auto prepared = prepare_lightmaps(*scene, asked);
            if (!prepared)
                return order.is_by_scene ? prepared.error().in(order.place) : prepared.error();
            settings_.common.warn(prepared->report.warnings);
            return plan_lightmaps(order, *scene, *prepared);
        });
    }

    Status plan_lightmaps(const SceneOrder& order, const Scene& scene,
                          const PreparedLightmaps& prepared) {
        Piece piece{result_of(order, "lightmaps", ".lightmaps", hex(prepared.key)), {}};
        piece.result.command = {{"command", "merge"}};
        const auto is_relit = relights(
            scene, prepared.settings.lighting, [&] { return dump(*order.lightmaps); }, piece);
        if (!is_relit) return is_relit.error();
        if (*is_relit) return Ok{};
        if (!keep_tasks(piece)) {
            piece.result.bytes = estimate_bytes(prepared);
            const auto estimate = estimate_rays(scene, prepared.places(), prepared.settings.bake,
                                                prepared.occlusion_lights, watch_signals);
            if (!estimate) return estimate.error();
            Json command = command_of("lightmap", *order.lightmaps);
            command["resume"] = true;
            if (prepared.has_cache()) {
                command["cache"] = str_cat("cache/", order.name);
                add_cache(*estimate, command, piece);
            }
            add_ranges(*estimate, {"lightmaps", "texels", prepared.baked.size()}, command,
                       prepared.has_cache() ? 1 : 0, piece);
        }
        add_parts(piece);
        pieces_.push_back(std::move(piece));
        return Ok{};
    }

    /// The task that makes the radiance cache, and bakes a texel.
    void add_cache(const RayEstimate& estimate, Json command, Piece& piece) const {
        command["texels"] = "0..1";
        command["output"] = part_of(piece.result, kCachePart, ".part");
        const double rays = kCacheShare * estimate.rays;
        add_task(str_cat(piece.result.scene, ": radiance cache"), rays, estimate.rays_per_second,
                 command, 0, piece);
    }

    Status add_reflections(const SceneOrder& order) {
        if (!order.reflections) return Ok{};
        return guarded(order, "reflections", [&]() -> Status {
            const auto values = values_of(order, settings::kReflect, *order.reflections);
            if (!values) return values.error();
            const ReflectInputs inputs(*values);
            const auto scene = inputs.scene_options.read();
            if (!scene) return scene.error();
            const auto places = inputs.places(*scene);
            if (!places) return places.error();
            if (order.is_by_scene && places->empty()) return Ok{};
            if (auto status = check_reflections(*scene, *places, inputs.settings); !status)
                return inputs.in_file(status.error());
            return plan_reflections(order, *scene, inputs, *places);
        });
    }

    Status plan_reflections(const SceneOrder& order, const Scene& scene,
                            const ReflectInputs& inputs,
                            const std::vector<ReflectionPlace>& places) {
        Json command = command_of("reflect", *order.reflections);
        const std::string content =
            str_cat("reflections, tetralight " TETRALIGHT_VERSION " ", dump(command),
                    dump(reflection_places_json(places)), key_of_file(inputs.lightmaps_path));
        const std::string key = key_of(content + hex(scene_key(scene)));
        Piece piece{result_of(order, "reflections", ".ktx2", key), {}};
        const auto is_relit = relights(
            scene, {.layers = inputs.settings.layers}, [&] { return content; }, piece);
        if (!is_relit) return is_relit.error();
        if (*is_relit) return Ok{};
        command["store"] = str_cat("cubes/", order.name);
        piece.result.command = command;
        const double size = inputs.settings.cube_size;
        const double rays = 6.0 * size * size * inputs.settings.bake.sample_count * kRaysPerPath;
        std::set<std::string> names;
        for (const ReflectionPlace& place : places) names.insert(place.name);
        // A name chooses a place only if it has it alone.
        const bool is_split = names.size() == places.size() && inputs.given_places.empty();
        for (size_t i = 0; i < (is_split ? places.size() : size_t{1}); ++i) {
            Json task = command;
            if (is_split) task["probe"] = {places[i].name};
            task["output"] = part_of(piece.result, task_digits(i), ".ktx2");
            add_task(str_cat(order.name, ": reflections",
                             is_split ? str_cat(" of ", places[i].name) : ""),
                     is_split ? rays : rays * static_cast<double>(places.size()), 0.0, task, 0,
                     piece);
        }
        pieces_.push_back(std::move(piece));
        return Ok{};
    }

    [[nodiscard]] static bool watch_signals(const BakeProgress&) {
        return Interrupt::signal() == 0;
    }

    [[nodiscard]] std::string in_job(const std::string& path) const {
        return (fs::path(settings_.job) / path).string();
    }

    [[nodiscard]] static Json command_of(const char* name, const Json& values) {
        Json command{{"command", name}};
        command.update(values);
        return command;
    }

    /// The key of a result counts how it is cut: another cut has other tasks.
    [[nodiscard]] PlanResult result_of(const SceneOrder& order, const char* kind,
                                       const char* extension, const std::string& key) const {
        const std::string cut = settings_.task_count > 0 ? std::to_string(settings_.task_count)
                                                         : str_cat(settings_.task_seconds, " s");
        return {order.name, kind, order.name + extension, key_of(str_cat(key, ", ", cut)), 0,
                {},         {}};
    }

    [[nodiscard]] static std::string part_of(const PlanResult& result, const std::string& what,
                                             const char* extension) {
        return str_cat("parts/", result.scene, ".", result.kind, ".", what, extension);
    }

    /// Takes the tasks of the old plan if it has the same result and prepared bake.
    bool keep_tasks(Piece& piece) const {
        const PlanResult* same = same_result(piece.result);
        if (same == nullptr || same->tasks.empty()) return false;
        const Json& command = piece.result.command;
        const auto prepared = command.find("prepared");
        std::error_code ignored;
        if (prepared != command.end() &&
            !fs::is_regular_file(in_job(prepared->get<std::string>()), ignored))
            return false;
        for (const size_t index : same->tasks) {
            const auto phase = std::ranges::find_if(
                old_.phases, [&](const PlanPhase& one) { return index < one.end; });
            piece.tasks.push_back(
                {static_cast<size_t>(phase - old_.phases.begin()), old_.tasks[index]});
        }
        piece.result.bytes = same->bytes;
        return true;
    }

    /// What is cut into ranges: the kind of light, and the setting of its places.
    struct Places {
        const char* kind;
        const char* setting;
        size_t count;
    };

    void add_ranges(const RayEstimate& estimate, const Places& places, const Json& command,
                    size_t phase, Piece& piece) const {
        const double seconds = estimate.rays / std::max(estimate.rays_per_second, 1.0);
        const size_t by_time =
            static_cast<size_t>(std::min(std::ceil(seconds / settings_.task_seconds), 1e5));
        const size_t count = settings_.task_count > 0 ? settings_.task_count : by_time;
        const auto ranges = spread_ranges(places.count, count);
        for (size_t i = 0; i < ranges.size(); ++i) {
            const PlaceRange& range = ranges[i];
            const double rays =
                estimate.rays * range.count() / std::max(static_cast<double>(places.count), 1.0);
            Json task = command;
            task[places.setting] = name_of(range);
            task["output"] = part_of(piece.result, task_digits(i), ".part");
            add_task(str_cat(piece.result.scene, ": ", places.kind, " ", name_of(range)), rays,
                     estimate.rays_per_second, task, phase, piece);
        }
    }

    /// `rate`: rays a second; 0: not measured.
    static void add_task(const std::string& name, double rays, double rate, const Json& command,
                         size_t phase, Piece& piece) {
        const double seconds = rays / (rate > 0.0 ? rate : kRaysPerSecond);
        piece.tasks.push_back(
            {phase, {name, seconds, rays, key_of(piece.result.key + dump(command)), command}});
    }

    /// The joining command takes what the tasks write, but for the part of a cache.
    static void add_parts(Piece& piece) {
        Json parts = Json::array();
        for (const SceneTask& task : piece.tasks)
            if (task.task.output() != part_of(piece.result, kCachePart, ".part"))
                parts.push_back(task.task.output());
        piece.result.command["parts"] = std::move(parts);
    }

    /// Numbers the tasks by phases.
    [[nodiscard]] PlanFile numbered() const {
        PlanFile plan;
        plan.scenes = scenes_;
        size_t phase_count = 1;
        for (const Piece& piece : pieces_) {
            for (const SceneTask& task : piece.tasks)
                phase_count = std::max(phase_count, task.phase + 1);
            plan.results.push_back(piece.result);
        }
        for (size_t phase = 0; phase < phase_count; ++phase) {
            const size_t begin = plan.tasks.size();
            for (size_t i = 0; i < pieces_.size(); ++i) {
                for (const SceneTask& task : pieces_[i].tasks) {
                    if (task.phase != phase) continue;
                    plan.results[i].tasks.push_back(plan.tasks.size());
                    plan.tasks.push_back(task.task);
                }
            }
            plan.phases.push_back({begin, plan.tasks.size()});
        }
        return plan;
    }

    const PlanSettings& settings_;
    PlanFile old_;
    std::vector<PlanScene> scenes_;
    std::vector<Piece> pieces_;
};

}  // namespace

Result<PlanFile> make_plan(std::span<const SceneOrder> orders, const PlanSettings& settings) {
    const Interrupt interrupt;
    return Planner(settings).run(orders);
}

}  // namespace tetralight::cli
