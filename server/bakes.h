// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <tetralight/server/open_volumes.h>
#include <tetralight/server/store.h>

namespace tetralight::server {

/// What a client asked for, ready to be run in a folder that holds its inputs.
struct BakeOrder {
    /// As it came.
    Json request;
    /// Options of `tetralight bake` behind "scene.glb".
    std::vector<std::string> arguments;
    /// Of the volume; empty: none.
    std::string name;
    int64_t priority = 0;
    /// Each under the name that the arguments have for it.
    std::vector<std::pair<StoredFile, std::string>> inputs;
};

/// Bakes that wait, run and are over. One runs at a time, on all processors: that of the highest
/// priority, the oldest of these. What was accepted is on the disk, and what a bake has finished
/// is, too: after a crash each goes on, and ends with the same bytes. Thread-safe; functions throw
/// a `Problem`.
class Bakes {
  public:
    /// Goes on with what the store's database has. Keeps references.
    Bakes(const Settings& settings, Store& store, Log& log);

    /// Ends the running bake, which goes on the next time.
    ~Bakes();

    Bakes(const Bakes&) = delete;
    Bakes& operator=(const Bakes&) = delete;

    [[nodiscard]] Json submit(const BakeOrder& order);
    [[nodiscard]] Json get(const std::string& id) const;
    /// The newest first.
    [[nodiscard]] Json list() const;
    /// Ends a bake that is not over.
    [[nodiscard]] Json cancel(const std::string& id);
    /// Forgets a bake that is over.
    void remove(const std::string& id);

    [[nodiscard]] bool is_over(const std::string& id) const;
    /// How many are in a state.
    [[nodiscard]] size_t count(const std::string& state) const;

  private:
    struct Bake {
        int64_t number = 0;
        std::string id;
        Json request;
        std::vector<std::string> arguments;
        std::string name;
        int64_t priority = 0;
        std::string state = "queued";
        std::string volume;
        std::string error;
        Json report;
        double created = 0.0;
        double ended = 0.0;
        /// By the chunks on the disk.
        uint64_t probes_done = 0;
        uint64_t probe_count = 0;
        /// Of the run that goes on; null: not known.
        Json rays_per_second;
        Json seconds_left;
    };

    [[nodiscard]] static Json to_json(const Bake& bake);
    void load();
    void drop_unknown_folders() const;
    [[nodiscard]] const Bake& find_locked(const std::string& id) const;
    [[nodiscard]] size_t waiting_locked() const;
    [[nodiscard]] Bake* next_locked();
    void run();
    void run_bake(const std::string& id, const std::vector<std::string>& arguments,
                  const std::string& name);
    [[nodiscard]] bool goes_on(const std::string& id);
    void update_progress(const std::string& id);
    [[nodiscard]] bool fail(const std::string& id, const std::string& error);
    void end(const std::string& id, const std::string& state, const std::string& volume,
             const std::string& error, const Json& report);

    const Settings settings_;
    Store& store_;
    Log& log_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    bool is_ending_ = false;
    std::map<std::string, Bake> bakes_;
    std::thread thread_;
};

}  // namespace tetralight::server
