// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/bakes.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <new>
#include <random>

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
constexpr const char* kResult = "results/result.probes";

/// Before the name of a folder until its bake is accepted.
constexpr const char* kNew = "new-";

std::string random_id() {
    static std::random_device device;
    std::array<char, 24> digits{};
    std::snprintf(digits.data(), digits.size(), "%08x%08x", device(), device());
    return digits.data();
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

/// What is out of reach or used up for now keeps its status, 503.
Problem bake_problem(const Error& error) {
    const bool can_wait =
        error.code == ErrorCode::Unavailable || error.code == ErrorCode::OutOfResources;
    return can_wait ? storage_problem(error) : Problem{500, "bake_failed", detail_of(error)};
}

bool is_final(const std::string& state) {
    return state == "done" || state == "failed" || state == "cancelled";
}

}  // namespace

Bakes::Bakes(const Settings& settings, Store& store, Log& log)
    : settings_(settings), store_(store), log_(log) {
    if (settings.is_read_only) return;
    load();
    clear_folders();
    thread_ = std::thread([this] { run(); });
}

Bakes::~Bakes() {
    {
        const std::lock_guard lock(mutex_);
        is_ending_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Bakes::load() {
    for (const auto& row : store_.database().run(
             "SELECT number, id, request, name, priority, state, volume, error, report, created, "
             "ended, probes_done, probe_count FROM bakes")) {
        Bake bake;
        bake.number = std::get<int64_t>(row[0]);
        bake.id = std::get<std::string>(row[1]);
        bake.request = Json::parse(std::get<std::string>(row[2]), nullptr, false);
        bake.name = std::get<std::string>(row[3]);
        bake.priority = std::get<int64_t>(row[4]);
        bake.state = std::get<std::string>(row[5]);
        bake.volume = std::get<std::string>(row[6]);
        bake.error = std::get<std::string>(row[7]);
        const auto& report = std::get<std::string>(row[8]);
        if (!report.empty()) bake.report = Json::parse(report, nullptr, false);
        bake.created = std::get<double>(row[9]);
        bake.ended = std::get<double>(row[10]);
        bake.probes_done = static_cast<uint64_t>(std::get<int64_t>(row[11]));
        bake.probe_count = static_cast<uint64_t>(std::get<int64_t>(row[12]));
        bakes_[bake.id] = std::move(bake);
    }
}

/// Removes the folders of bakes that were never accepted or have ended. Those that no row tells of
/// are put aside: the database may be older than they are.
void Bakes::clear_folders() const {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(store_.bake_folder(""), error)) {
        const std::string name = entry.path().filename().string();
        const auto known = bakes_.find(name);
        const bool is_known = known != bakes_.end();
        if (is_known && !is_final(known->second.state)) continue;
        if (is_known || name.starts_with(kNew)) {
            remove_all(entry.path().string());
        } else if (store_.put_aside(entry.path().string(), "bake-" + name)) {
            store_.report(str_cat("bakes/", name, " is not in the database and is in quarantine"));
        }
    }
}

Json Bakes::to_json(const Bake& bake) {
    Json json{{"id", bake.id},
              {"state", bake.state},
              {"priority", bake.priority},
              {"name", bake.name},
              {"created", bake.created},
              {"probes_done", bake.probes_done},
              {"probe_count", bake.probe_count}};
    if (bake.ended > 0.0) json["ended"] = bake.ended;
    if (!is_final(bake.state)) {
        json["rays_per_second"] = bake.rays_per_second;
        json["seconds_left"] = bake.seconds_left;
    }
    if (!bake.volume.empty()) json["volume"] = bake.volume;
    if (!bake.error.empty()) json["error"] = bake.error;
    if (!bake.report.empty()) json["report"] = bake.report;
    json["request"] = bake.request;
    return json;
}

const Bakes::Bake& Bakes::find_locked(const std::string& id) const {
    const auto found = bakes_.find(id);
    if (found != bakes_.end()) return found->second;
    throw Problem{404, "not_found", "there is no such bake", "bake", id.substr(0, 200)};
}

size_t Bakes::waiting_locked() const {
    return static_cast<size_t>(std::ranges::count_if(
        bakes_, [](const auto& entry) { return !is_final(entry.second.state); }));
}

Json Bakes::submit(const BakeOrder& order) {
    {
        const std::lock_guard lock(mutex_);
        if (waiting_locked() >= settings_.max_queued_bakes) {
            throw Problem{429, "queue_full",
                          str_cat(settings_.max_queued_bakes, " bakes are queued already")};
        }
    }
    Bake bake;
    bake.id = random_id();
    bake.request = order.request;
    bake.name = order.name;
    bake.priority = order.priority;
    bake.created = now();
    const std::string folder = store_.bake_folder(bake.id);
    const std::string new_folder = store_.bake_folder(kNew + bake.id);
    try {
        require_stored(make_folder(new_folder));
        for (const auto& [file, name] : order.inputs) store_.link(file, new_folder + "/" + name);
        require_stored(make_folder(new_folder + "/" + kResults));
        require_stored(sync_folder(new_folder));
        store_.database().transaction([&] {
            store_.database().run(
                "INSERT INTO bakes (id, request, name, priority, state, created) "
                "VALUES (?, ?, ?, ?, 'queued', ?)",
                {bake.id, dump(bake.request), bake.name, bake.priority, bake.created});
            for (const auto& [file, name] : order.inputs) {
                store_.database().run("INSERT INTO bake_inputs (bake, kind, file) VALUES (?, ?, ?)",
                                      {bake.id, std::string(name_of(file.kind)), file.id});
            }
            bake.number = std::get<int64_t>(
                store_.database().run("SELECT number FROM bakes WHERE id = ?", {bake.id})[0][0]);
            // Before the commit, so that every accepted bake has its folder.
            require_stored(move_folder_synced(new_folder, folder));
        });
    } catch (...) {
        remove_all(new_folder);
        remove_all(folder);
        throw;
    }
    const std::lock_guard lock(mutex_);
    bakes_[bake.id] = bake;
    wake_.notify_all();
    return to_json(bake);
}

Json Bakes::get(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    return to_json(find_locked(id));
}

bool Bakes::is_over(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    const auto found = bakes_.find(id);
    return found == bakes_.end() || is_final(found->second.state);
}

Json Bakes::list() const {
    const std::lock_guard lock(mutex_);
    std::vector<const Bake*> all;
    for (const auto& [id, bake] : bakes_) all.push_back(&bake);
    std::ranges::sort(all, std::greater(), &Bake::number);
    Json json = Json::array();
    for (const Bake* bake : all) json.push_back(to_json(*bake));
    return json;
}

Json Bakes::unfinished_and_newer(int64_t& number) const {
    const std::lock_guard lock(mutex_);
    Json json = Json::array();
    int64_t highest = 0;
    for (const auto& [id, bake] : bakes_) {
        highest = std::max(highest, bake.number);
        if (is_final(bake.state) && bake.number <= number) continue;
        json.push_back(to_json(bake));
        json.back().erase("request");
    }
    number = highest;
    return json;
}

size_t Bakes::count(const std::string& state) const {
    const std::lock_guard lock(mutex_);
    return static_cast<size_t>(std::ranges::count_if(
        bakes_, [&](const auto& entry) { return entry.second.state == state; }));
}

double Bakes::last_done() const {
    const std::lock_guard lock(mutex_);
    double last = 0.0;
    for (const auto& [id, bake] : bakes_) {
        if (bake.state == "done") last = std::max(last, bake.ended);
    }
    return last;
}

Json Bakes::cancel(const std::string& id) {
    bool is_running = false;
    {
        const std::lock_guard lock(mutex_);
        const Bake& bake = find_locked(id);
        if (is_final(bake.state)) {
            throw Problem{409, "is_over", "the bake has ended: " + bake.state, "bake", id};
        }
        is_running = bake.state == "running";
    }
    end(id, "cancelled", "", "", {});
    // The thread that runs a bake ends it and then removes its folder.
    if (!is_running) remove_all(store_.bake_folder(id));
    return get(id);
}

void Bakes::remove(const std::string& id) {
    const std::lock_guard lock(mutex_);
    if (!is_final(find_locked(id).state)) {
        throw Problem{409, "not_over", "the bake has not ended; cancel it first", "bake", id};
    }
    store_.with_reserve([&] { store_.database().run("DELETE FROM bakes WHERE id = ?", {id}); });
    remove_all(store_.bake_folder(id));
    bakes_.erase(id);
}

/// Only the first end of a bake counts.
void Bakes::end(const std::string& id, const std::string& state, const std::string& volume,
                const std::string& error, const Json& report) {
    const std::lock_guard lock(mutex_);
    const auto found = bakes_.find(id);
    if (found == bakes_.end() || is_final(found->second.state)) return;
    Bake bake = found->second;
    bake.state = state;
    bake.volume = volume;
    bake.error = error;
    bake.report = report;
    bake.ended = now();
    if (state == "done") bake.probes_done = bake.probe_count = report.value("probes", 0u);
    store_.with_reserve([&] {
        store_.database().run(
            "UPDATE bakes SET state = ?, volume = ?, error = ?, report = ?, ended = ?, "
            "probes_done = ?, probe_count = ? WHERE id = ?",
            {state, volume, error, report.empty() ? "" : dump(report), bake.ended,
             static_cast<int64_t>(bake.probes_done), static_cast<int64_t>(bake.probe_count), id});
    });
    found->second = std::move(bake);
    log_.write(Log::Level::Info, "a bake has ended",
               {{"bake", id}, {"state", state}, {"volume", volume}, {"error", error}});
}

/// Puts a bake back into the queue, and waits, if it lacks a file or resources that may come back.
/// Returns false if it must fail.
bool Bakes::wait_to_retry(const std::string& id, const Problem& problem) {
    constexpr int kMostRetries = 3;
    std::unique_lock lock(mutex_);
    const auto found = bakes_.find(id);
    if (problem.status != 503 || found == bakes_.end() || found->second.state != "running" ||
        found->second.retries == kMostRetries) {
        return false;
    }
    found->second.state = "queued";
    const auto delay = std::chrono::seconds(1 << found->second.retries++);
    log_.write(Log::Level::Warning, "a bake waits to be tried again",
               {{"bake", id}, {"error", problem.detail}, {"seconds", delay.count()}});
    wake_.wait_for(lock, delay, [&] { return is_ending_; });
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
        if (bake.state != "queued") continue;
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
        const std::string id = next->id;
        const Json request = next->request;
        const std::string name = next->name;
        lock.unlock();
        log_.write(Log::Level::Info, "a bake begins", {{"bake", id}});
        if (const auto problem = try_bake(id, request, name)) {
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
    bake.probes_done = pace.value("probes_done", bake.probes_done);
    bake.probe_count = pace.value("probe_count", bake.probe_count);
    bake.rays_per_second = pace.value("rays_per_second", Json());
    bake.seconds_left = pace.value("seconds_left", Json());
}

/// Why a bake could not end; nothing if it did.
std::optional<Problem> Bakes::try_bake(const std::string& id, const Json& request,
                                       const std::string& name) {
    try {
        run_bake(id, request, name);
        return std::nullopt;
    } catch (const Problem& problem) {
        return problem;
    } catch (const std::bad_alloc&) {
        return Problem{503, "no_memory", "not enough memory"};
    } catch (const std::exception& exception) {
        return Problem{500, "internal", exception.what()};
    }
}

void Bakes::run_bake(const std::string& id, const Json& request, const std::string& name) {
    using End = JobResult::End;
    const std::string folder = store_.bake_folder(id);
    const auto run = [&](Job job) {
        job.folder = folder;
        return run_job(settings_, job);
    };
    rename_old_files(folder);
    remove_all(folder + "/" + kProgress);  // of an earlier run
    Json order = job_settings(settings::kBake, request);
    order.update({{"output", kResult}, {"chunks", kChunks}, {"progress_file", kProgress}});
    update_progress(id);
    const JobResult bake =
        run({.command = "bake", .settings = order, .is_background = true, .is_cancelled = [&] {
                 return is_cancelled(id);
             }});
    // When the server stops, the bake keeps its state and continues at the next start.
    if (bake.end == End::Cancelled) return;
    if (bake.end != End::Done) throw bake_problem(bake.error);
    const JobResult info = run({.command = "info", .settings = {{"volume", kResult}}});
    if (info.end != End::Done) throw bake_problem(info.error);
    std::string volume;
    store_.with_reserve([&] {
        volume = store_.add(Kind::Volumes, folder + "/" + kResult, name, info.report).file.id;
    });
    end(id, "done", volume, "", bake.report);
}

}  // namespace tetralight::server
