// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <tetralight/server/open_volumes.h>
#include <tetralight/server/order.h>
#include <tetralight/server/store.h>

namespace tetralight::server {

/// A checked order of a client.
struct BakeOrder {
    /// What it makes: volumes, lightmaps or reflection probes.
    Kind kind = Kind::Volumes;
    /// As the client sent it.
    Json request;
    /// Name of the result; empty: none.
    std::string name;
    int64_t priority = 0;
    /// Bakes that are reported together; empty: none.
    std::string batch;
    std::vector<OrderFile> inputs;
};

/// The settings of bakes that make files of a kind.
[[nodiscard]] const settings::Table& bake_table(Kind kind);

/// The members for what a bake counts, in its progress file and in answers.
struct CountMembers {
    const char* done;
    const char* all;
};

[[nodiscard]] CountMembers count_members(Kind kind);

/// True of "done", "failed" and "cancelled".
[[nodiscard]] bool is_final(const std::string& state);

/// Queued, running and finished bakes. So many bakes as the settings allow run at once, on this
/// machine or on a cluster: the oldest of the highest priority first. Accepted bakes and finished
/// probes are on the disk: after a crash each bake continues and gives the same bytes. Thread-safe;
/// functions throw a `Problem`.
class Bakes {
  public:
    /// Continues the unfinished bakes of the store's database. Keeps references.
    Bakes(const Settings& settings, Store& store, Log& log);

    /// Stops the running bakes, which continue at the next start.
    ~Bakes();

    Bakes(const Bakes&) = delete;
    Bakes& operator=(const Bakes&) = delete;

    [[nodiscard]] Json submit(const BakeOrder& order);
    [[nodiscard]] Json get(const std::string& id) const;
    /// Newest first.
    [[nodiscard]] Json list() const;

    /// A part of the list.
    struct Part {
        Json bakes = Json::array();
        /// Where the next part begins; empty: there is none. Deleting a bake does not change it.
        std::string next;
    };

    /// At most `limit` bakes that follow a `next`, or the id of a bake; from the newest if it is
    /// empty. Throws 404 if it is neither.
    [[nodiscard]] Part list_after(const std::string& place, size_t limit) const;
    /// Cancels a queued or running bake.
    [[nodiscard]] Json cancel(const std::string& id);
    /// Deletes a finished bake.
    void remove(const std::string& id);

    /// The bakes that have not ended or have a number above this one, without their orders. Sets
    /// it to the highest number.
    [[nodiscard]] Json unfinished_and_newer(int64_t& number) const;

    [[nodiscard]] bool is_over(const std::string& id) const;
    /// The path of the newest preview: a volume, or lightmaps. Throws 404 if there is no such bake,
    /// or if it has ended or bakes reflection probes.
    [[nodiscard]] std::string preview_file_path(const std::string& id) const;
    /// The path of another file in the results of a bake of lightmaps. Throws 404 if there is no
    /// such bake, or if it bakes no lightmaps or has ended.
    [[nodiscard]] std::string preview_path(const std::string& id, const std::string& name) const;
    /// When a bake last ended well, in seconds since 1970; 0 = never.
    [[nodiscard]] double last_done() const;
    /// The number of bakes in a state.
    [[nodiscard]] size_t count(const std::string& state) const;

  private:
    struct Bake {
        int64_t number = 0;
        std::string id;
        Kind kind = Kind::Volumes;
        Json request;
        std::string name;
        int64_t priority = 0;
        std::string state = "queued";
        std::string result;  ///< id of the volume, the lightmaps or the reflection probes
        std::string error;
        Json report;
        double created = 0.0;
        double ended = 0.0;
        /// Number of starts that failed because a file or a resource was missing.
        int retries = 0;
        /// Queued, until a thread has waited to try it again.
        bool is_waiting = false;
        /// Of the progress file of the running command. Bakes of lightmaps count texels, those of
        /// reflection probes rows of texels.
        uint64_t probes_done = 0;
        uint64_t probe_count = 0;
        /// Of the current run; null: not known.
        Json rays_per_second;
        Json seconds_left;
        Json at_target;
        Json share_at_target;
        Json preview;
    };

    [[nodiscard]] static Json to_json(const Bake& bake);
    void load();
    void clear_folders() const;
    [[nodiscard]] std::string result_path_locked(const Bake& bake, const std::string& name) const;
    [[nodiscard]] const Bake& find_locked(const std::string& id) const;
    [[nodiscard]] std::vector<const Bake*> sorted_locked() const;
    [[nodiscard]] int64_t number_of_locked(const std::string& place) const;
    [[nodiscard]] size_t waiting_locked() const;
    [[nodiscard]] Bake* next_locked();
    void run();
    [[nodiscard]] std::optional<Problem> try_bake(const Bake& bake);
    void run_bake(const Bake& bake);
    [[nodiscard]] bool is_cancelled(const std::string& id);
    void update_progress(const std::string& id);
    [[nodiscard]] bool wait_to_retry(const std::string& id, const Problem& problem);
    [[nodiscard]] bool fail(const std::string& id, const std::string& error);
    void end(const std::string& id, const std::string& state, const std::string& result,
             const std::string& error, const Json& report);

    const Settings settings_;
    Store& store_;
    Log& log_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    bool is_ending_ = false;
    std::map<std::string, Bake> bakes_;
    std::vector<std::thread> threads_;
};

}  // namespace tetralight::server
