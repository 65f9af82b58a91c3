// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tetralight::server {

/// Threads that work for clients, and the work that waits for them.
///
/// Each client gets the same share of the work by its cost, however much it sends: start-time fair
/// queueing (Goyal, Vin and Cheng 1996). If there is no place left, the newest work of the client
/// that waits for most makes room for a client that waits for less. Thread-safe.
class WorkQueue {
  public:
    struct Limits {
        uint32_t threads = 1;
        /// Work that may wait, and the sum of its costs.
        uint32_t max_waiting = 256;
        uint64_t max_cost = UINT64_MAX;
        /// Added to the niceness of the threads.
        int niceness = 0;
    };

    /// A piece of work.
    class Item;
    using Handle = std::shared_ptr<Item>;

    explicit WorkQueue(const Limits& limits);

    WorkQueue(const WorkQueue&) = delete;
    WorkQueue& operator=(const WorkQueue&) = delete;

    /// Drops what waits and finishes what runs.
    ~WorkQueue();

    /// Adds work; null if there is no room for it. Work that costs more than all that may wait is
    /// taken by an empty queue.
    [[nodiscard]] Handle post(const std::string& client, uint64_t cost, std::function<void()> work);

    /// Returns true if the work has not begun and will not, now or since it made room.
    bool drop(const Handle& item);

    /// The same without dropping it.
    [[nodiscard]] bool is_dropped(const Handle& item) const;

    [[nodiscard]] size_t waiting_count() const;

  private:
    /// The virtual time at which work starts, and its number.
    using Key = std::pair<uint64_t, uint64_t>;

    struct Client {
        uint64_t finish = 0;  ///< virtual time at which its work ends
        uint64_t waiting_cost = 0;
    };

    void run();
    [[nodiscard]] bool is_full_for(uint64_t cost) const;
    [[nodiscard]] bool make_room(const std::string& client, uint64_t cost);
    [[nodiscard]] Handle take_locked(std::map<Key, Handle>::iterator place);

    const Limits limits_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::map<Key, Handle> waiting_;
    std::map<std::string, Client> clients_;
    uint64_t waiting_cost_ = 0;
    uint64_t time_ = 0;  ///< virtual: the start of the work that began last
    uint64_t next_number_ = 0;
    bool is_ending_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace tetralight::server
