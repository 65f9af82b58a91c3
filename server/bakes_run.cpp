// SPDX-License-Identifier: Apache-2.0
// How a bake runs and ends.
#include <tetralight/server/bakes.h>

#include <filesystem>
#include <new>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/job.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

// In the folder of a bake.
constexpr const char* kChunks = "results/chunks";
constexpr const char* kProgress = "results/progress.json";

std::string result_path(Kind kind) {
    return str_cat("results/result", extension_of(kind));
}

/// What the job of a bake gets beside the order.
Json own_settings(Kind kind) {
    Json json{{"output", result_path(kind)}, {"progress_file", kProgress}};
    json["chunks"] = kChunks;
    if (kind == Kind::Volumes) json["preview"] = "results/preview.probes";
    if (kind != Kind::Lightmaps) return json;
    json["preview"] = {"results/preview.png", "results/preview.lightmaps"};
    json["unwrapped"] = "results/scene.glb";
    return json;
}

/// Limits of leaks need their measure.
bool has_leak_limit(Kind kind, const Json& request) {
    const Json limits = request.value("limits", Json());
    return kind == Kind::Volumes && limits.is_object() && limits.contains("leak");
}

/// The number of probes or texels in the report of a bake; of reflection probes, whose report has
/// none, that of the progress file.
uint64_t final_count(Kind kind, const Json& report, uint64_t last_count) {
    if (kind == Kind::Reflections) return last_count;
    return report.value(kind == Kind::Lightmaps ? "baked" : "probes", uint64_t{0});
}

/// The progress file of the running command; an empty object if there is none.
Json read_pace(const std::string& path) {
    const auto bytes = read_file(path);
    return bytes ? object_in(*bytes) : Json::object();
}

/// In bakes that an earlier version accepted, the inputs have other names ("groups_0.json" instead
/// of "groups[0]"), and finished probes lie beside them.
void rename_old_files(const std::string& folder) {
    std::error_code ignored;
    fs::create_directory(folder + "/" + kResults, ignored);
    fs::rename(folder + "/chunks", folder + "/" + kChunks, ignored);
    for (const char* name : {"progress.json", "result.probes"}) remove_all(folder + "/" + name);
    for (const std::string& old_name : names_in(folder, ignored)) {
        const fs::path path = folder + "/" + old_name;
        const std::string extension = path.extension().string(), stem = path.stem().string();
        const bool is_old =
            (extension == ".glb" || extension == ".hdr" || extension == ".json" ||
             extension == ".probes") &&
            (stem == "scene" || stem == "sky" || stem == "reuse" || stem.starts_with("groups_"));
        const size_t number = stem.find('_');
        const std::string name =
            number == std::string::npos ? stem : str_cat("groups[", stem.substr(number + 1), "]");
        if (is_old) fs::rename(path, folder + "/" + name, ignored);
    }
}

/// Names the Slurm job of a bake; empty: it runs here.
std::string slurm_name(const Settings& settings, const std::string& id) {
    return settings.bakes_on == Settings::BakesOn::Slurm ? "tetralight-bake-" + id : "";
}

/// What is out of reach or used up for now keeps its status, 503.
Problem bake_problem(const Error& error) {
    const bool can_wait =
        error.code == ErrorCode::Unavailable || error.code == ErrorCode::OutOfResources;
    return can_wait ? storage_problem(error) : Problem{500, "bake_failed", detail_of(error)};
}

}  // namespace

/// Only the first end of a bake counts.
void Bakes::end(const std::string& id, const std::string& state, const std::string& result,
                const std::string& error, const Json& report) {
    const std::lock_guard lock(mutex_);
    const auto found = bakes_.find(id);
    if (found == bakes_.end() || is_final(found->second.state)) return;
    Bake bake = found->second;
    bake.state = state;
    bake.result = result;
    bake.error = error;
    bake.report = report;
    bake.ended = now();
    if (state == "done")
        bake.probes_done = bake.probe_count = final_count(bake.kind, report, bake.probe_count);
    store_.with_reserve([&] {
        store_.database().run(
            "UPDATE bakes SET state = ?, volume = ?, error = ?, report = ?, ended = ?, "
            "probes_done = ?, probe_count = ? WHERE id = ?",
            {state, result, error, report.empty() ? "" : dump(report), bake.ended,
             static_cast<int64_t>(bake.probes_done), static_cast<int64_t>(bake.probe_count), id});
    });
    const Kind kind = bake.kind;
    found->second = std::move(bake);
    log_.write(Log::Level::Info, "a bake has ended",
               {{"bake", id}, {"state", state}, {noun_of(kind), result}, {"error", error}});
}

/// Puts a bake back into the queue, and waits, if it lacks a file or resources that may come back.
/// Returns false if it must fail.
bool Bakes::wait_to_retry(const std::string& id, const Problem& problem) {
    // A cluster may be away for longer than a file: 17 minutes in all.
    const int most_retries = settings_.bakes_on == Settings::BakesOn::Slurm ? 10 : 3;
    std::unique_lock lock(mutex_);
    const auto found = bakes_.find(id);
    if (problem.status != 503 || found == bakes_.end() || found->second.state != "running" ||
        found->second.retries == most_retries) {
        return false;
    }
    found->second.state = "queued";
    found->second.is_waiting = true;
    const auto delay = std::chrono::seconds(1 << found->second.retries++);
    log_.write(Log::Level::Warning, "a bake waits to be tried again",
               {{"bake", id}, {"error", problem.detail}, {"seconds", delay.count()}});
    wake_.wait_for(lock, delay, [&] { return is_ending_; });
    const auto bake = bakes_.find(id);  // it may have been cancelled and deleted
    if (bake != bakes_.end()) bake->second.is_waiting = false;
    return true;
}

/// Returns false if the end could not be stored. The bake then keeps its folder and continues at
/// the next start.
bool Bakes::fail(const std::string& id, const std::string& error) {
    try {
        end(id, "failed", "", error, {});
        return true;
    } catch (const Problem& problem) {
        log_.write(Log::Level::Error, "the end of a bake could not be stored",
                   {{"bake", id}, {"error", problem.detail}});
    }
    const std::lock_guard lock(mutex_);
    const auto found = bakes_.find(id);
    if (found == bakes_.end()) return true;
    found->second.state = "failed";
    found->second.error = error;
    return false;
}

Bakes::Bake* Bakes::next_locked() {
    Bake* next = nullptr;
    for (auto& [id, bake] : bakes_) {
        if (bake.state != "queued" || bake.is_waiting) continue;
        const bool is_before = next == nullptr || bake.priority > next->priority ||
                               (bake.priority == next->priority && bake.number < next->number);
        if (is_before) next = &bake;
    }
    return next;
}

void Bakes::run() {
    while (true) {
        std::unique_lock lock(mutex_);
        Bake* next = nullptr;
        wake_.wait(lock, [&] { return is_ending_ || (next = next_locked()) != nullptr; });
        if (is_ending_) return;
        next->state = "running";
        const Bake bake = *next;
        const std::string& id = bake.id;
        lock.unlock();
        log_.write(Log::Level::Info, "a bake begins", {{"bake", id}});
        if (const auto problem = try_bake(bake)) {
            if (wait_to_retry(id, *problem) || !fail(id, problem->detail)) continue;
        }
        if (is_over(id)) remove_all(store_.bake_folder(id));
        store_.keep_reserve();
    }
}

bool Bakes::is_cancelled(const std::string& id) {
    update_progress(id);
    const std::lock_guard lock(mutex_);
    const auto found = bakes_.find(id);
    return is_ending_ || found == bakes_.end() || found->second.state != "running";
}

void Bakes::update_progress(const std::string& id) {
    const std::string folder = store_.bake_folder(id) + "/";
    const Json pace = read_pace(folder + kProgress);
    const std::lock_guard lock(mutex_);
    const auto found = bakes_.find(id);
    if (found == bakes_.end()) return;
    Bake& bake = found->second;
    const CountMembers members = count_members(bake.kind);
    bake.probes_done = pace.value(members.done, bake.probes_done);
    bake.probe_count = pace.value(members.all, bake.probe_count);
    bake.rays_per_second = pace.value("rays_per_second", Json());
    bake.seconds_left = pace.value("seconds_left", Json());
    bake.at_target = pace.value("at_target", Json());
    bake.share_at_target = pace.value("share_at_target", Json());
    bake.preview = pace.value("preview", Json());
}

/// Why a bake could not end; nothing if it did.
std::optional<Problem> Bakes::try_bake(const Bake& bake) {
    try {
        run_bake(bake);
        return std::nullopt;
    } catch (const Problem& problem) {
        return problem;
    } catch (const std::bad_alloc&) {
        return Problem{503, "no_memory", "not enough memory"};
    } catch (const std::exception& exception) {
        return Problem{500, "internal", exception.what()};
    }
}

void Bakes::run_bake(const Bake& bake) {
    using End = JobResult::End;
    const std::string folder = store_.bake_folder(bake.id);
    const auto run = [&](Job job) {
        job.folder = folder;
        return run_job(settings_, job);
    };
    rename_old_files(folder);
    remove_all(folder + "/" + kProgress);  // of an earlier run
    const settings::Table& table = bake_table(bake.kind);
    const std::string output = result_path(bake.kind);
    Json order = job_settings(table, bake.request);
    order.update(own_settings(bake.kind));
    if (has_leak_limit(bake.kind, bake.request)) order["check_leaks"] = true;
    update_progress(bake.id);
    const JobResult baked = run({.command = std::string(table.command),
                                 .settings = order,
                                 .is_background = true,
                                 .slurm_name = slurm_name(settings_, bake.id),
                                 .is_cancelled = [&] { return is_cancelled(bake.id); }});
    // When the server stops, the bake keeps its state and continues at the next start.
    if (baked.end == End::Cancelled) return;
    if (baked.end != End::Done) throw bake_problem(baked.error);
    update_progress(bake.id);  // its last words
    const JobResult info = run({.command = "info", .settings = {{"volume", output}}});
    if (info.end != End::Done) throw bake_problem(info.error);
    std::string result;
    store_.with_reserve([&] {
        result = store_.add(bake.kind, folder + "/" + output, bake.name, info.report).file.id;
    });
    end(bake.id, "done", result, "", baked.report);
}

}  // namespace tetralight::server
