// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/bakes.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <limits>
#include <random>
#include <string_view>

#include <tetralight/base/str_cat.h>
#include <tetralight/server/job.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

/// Before the name of a folder until its bake is accepted.
constexpr const char* kNew = "new-";

/// Before the number of a bake in a place of their list. Ids are hexadecimal.
constexpr std::string_view kBefore = "before-";

std::string random_id() {
    std::random_device device;
    std::array<char, 24> digits{};
    std::snprintf(digits.data(), digits.size(), "%08x%08x", device(), device());
    return digits.data();
}

}  // namespace

const settings::Table& bake_table(Kind kind) {
    if (kind == Kind::Reflections) return settings::kReflect;
    return kind == Kind::Lightmaps ? settings::kLightmap : settings::kBake;
}

bool is_final(const std::string& state) {
    return state == "done" || state == "failed" || state == "cancelled";
}

CountMembers count_members(Kind kind) {
    if (kind == Kind::Reflections) return {"rows_done", "row_count"};
    if (kind == Kind::Lightmaps) return {"texels_done", "texel_count"};
    return {"probes_done", "probe_count"};
}

Bakes::Bakes(const Settings& settings, Store& store, Log& log)
    : settings_(settings), store_(store), log_(log) {
    if (settings.is_read_only) return;
    load();
    clear_folders();
    for (uint32_t i = 0; i < settings.bakes_at_once; ++i) threads_.emplace_back([this] { run(); });
}

Bakes::~Bakes() {
    {
        const std::lock_guard lock(mutex_);
        is_ending_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void Bakes::load() {
    for (const auto& row : store_.database().run(
             "SELECT number, id, request, name, priority, state, volume, error, report, created, "
             "ended, probes_done, probe_count, kind FROM bakes")) {
        Bake bake;
        bake.number = std::get<int64_t>(row[0]);
        bake.id = std::get<std::string>(row[1]);
        bake.request = Json::parse(std::get<std::string>(row[2]), nullptr, false);
        bake.name = std::get<std::string>(row[3]);
        bake.priority = std::get<int64_t>(row[4]);
        bake.state = std::get<std::string>(row[5]);
        bake.result = std::get<std::string>(row[6]);
        bake.error = std::get<std::string>(row[7]);
        const auto& report = std::get<std::string>(row[8]);
        if (!report.empty()) bake.report = Json::parse(report, nullptr, false);
        bake.created = std::get<double>(row[9]);
        bake.ended = std::get<double>(row[10]);
        bake.probes_done = static_cast<uint64_t>(std::get<int64_t>(row[11]));
        bake.probe_count = static_cast<uint64_t>(std::get<int64_t>(row[12]));
        bake.kind = find_kind(std::get<std::string>(row[13])).value_or(Kind::Volumes);
        bakes_[bake.id] = std::move(bake);
    }
}

/// Removes the folders of bakes that were never accepted or have ended. Those that no row tells of
/// are put aside: the database may be older than they are.
void Bakes::clear_folders() const {
    std::error_code error;
    for (const std::string& name : names_in(store_.bake_folder(""), error)) {
        const std::string path = store_.bake_folder(name);
        const auto known = bakes_.find(name);
        const bool is_known = known != bakes_.end();
        if (is_known && !is_final(known->second.state)) continue;
        if (is_known || name.starts_with(kNew)) {
            remove_all(path);
        } else if (store_.put_aside(path, "bake-" + name)) {
            store_.report(str_cat("bakes/", name, " is not in the database and is in quarantine"));
        }
    }
}

Json Bakes::to_json(const Bake& bake) {
    const CountMembers members = count_members(bake.kind);
    Json json{{"id", bake.id},
              {"kind", name_of(bake.kind)},
              {"state", bake.state},
              {"priority", bake.priority},
              {"name", bake.name},
              {"created", bake.created},
              {members.done, bake.probes_done},
              {members.all, bake.probe_count}};
    if (bake.ended > 0.0) json["ended"] = bake.ended;
    if (!is_final(bake.state)) {
        json["rays_per_second"] = bake.rays_per_second;
        json["seconds_left"] = bake.seconds_left;
        json["at_target"] = bake.at_target;
        json["share_at_target"] = bake.share_at_target;
        if (bake.kind != Kind::Reflections) json["preview"] = bake.preview;
    }
    if (!bake.result.empty()) json[noun_of(bake.kind)] = bake.result;
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
    bake.kind = order.kind;
    bake.request = order.request;
    bake.name = order.name;
    bake.priority = order.priority;
    bake.created = now();
    const std::string folder = store_.bake_folder(bake.id);
    const std::string new_folder = store_.bake_folder(kNew + bake.id);
    try {
        require_stored(make_subfolder(new_folder));
        for (const auto& [file, name] : order.inputs) store_.link(file, new_folder + "/" + name);
        require_stored(make_subfolder(new_folder + "/" + kResults));
        require_stored(sync_folder(new_folder));
        store_.database().transaction([&] {
            store_.database().run(
                "INSERT INTO bakes (id, request, name, priority, state, created, kind) "
                "VALUES (?, ?, ?, ?, 'queued', ?, ?)",
                {bake.id, dump(bake.request), bake.name, bake.priority, bake.created,
                 std::string(name_of(bake.kind))});
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

std::string Bakes::preview_path(const std::string& id, const std::string& name) const {
    const std::lock_guard lock(mutex_);
    const Bake& bake = find_locked(id);
    if (bake.kind != Kind::Lightmaps)
        throw Problem{404, "not_found", "only bakes of lightmaps have pages and a scene", "bake",
                      id};
    return result_path_locked(bake, name);
}

std::string Bakes::preview_file_path(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    const Bake& bake = find_locked(id);
    if (bake.kind == Kind::Reflections) {
        throw Problem{404, "not_found", "bakes of reflection probes have no preview", "bake", id};
    }
    return result_path_locked(bake, str_cat("preview", extension_of(bake.kind)));
}

std::string Bakes::result_path_locked(const Bake& bake, const std::string& name) const {
    if (!is_final(bake.state))
        return str_cat(store_.bake_folder(bake.id), "/", kResults, "/", name);
    throw Problem{404, "not_found", "the bake has ended: " + bake.state, "bake", bake.id};
}

/// Newest first.
std::vector<const Bakes::Bake*> Bakes::sorted_locked() const {
    std::vector<const Bake*> all;
    for (const auto& [id, bake] : bakes_) all.push_back(&bake);
    std::ranges::sort(all, std::greater(), &Bake::number);
    return all;
}

Json Bakes::list() const {
    const std::lock_guard lock(mutex_);
    Json json = Json::array();
    for (const Bake* bake : sorted_locked()) json.push_back(to_json(*bake));
    return json;
}

/// The number of a bake, also of one that was deleted: "before-17".
int64_t Bakes::number_of_locked(const std::string& place) const {
    if (const auto found = bakes_.find(place); found != bakes_.end()) return found->second.number;
    int64_t number = 0;
    const std::string_view digits =
        std::string_view(place).substr(place.starts_with(kBefore) ? kBefore.size() : place.size());
    const char* end = digits.data() + digits.size();
    const auto [rest, error] = std::from_chars(digits.data(), end, number);
    if (error == std::errc{} && rest == end && number > 0) return number;
    throw Problem{404, "not_found", "there is no such bake", "after", place.substr(0, 200)};
}

Bakes::Part Bakes::list_after(const std::string& place, size_t limit) const {
    const std::lock_guard lock(mutex_);
    const int64_t after =
        place.empty() ? std::numeric_limits<int64_t>::max() : number_of_locked(place);
    Part part;
    const Bake* last = nullptr;
    for (const Bake* bake : sorted_locked()) {
        if (bake->number >= after) continue;
        if (part.bakes.size() == limit) {
            part.next = str_cat(kBefore, last->number);
            break;
        }
        part.bakes.push_back(to_json(*bake));
        last = bake;
    }
    return part;
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

}  // namespace tetralight::server
