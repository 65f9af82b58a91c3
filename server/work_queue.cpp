// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/work_queue.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace tetralight::server {

class WorkQueue::Item {
  public:
    enum class State : uint8_t { Waiting, Begun, Dropped };

    std::string client;
    uint64_t cost = 0;
    std::function<void()> work;
    Key key;
    State state = State::Waiting;
};

WorkQueue::WorkQueue(const Limits& limits) : limits_(limits) {
    for (uint32_t i = 0; i < limits.threads; ++i) threads_.emplace_back([this] { run(); });
}

WorkQueue::~WorkQueue() {
    {
        const std::lock_guard lock(mutex_);
        is_ending_ = true;
        for (auto& [key, item] : waiting_) item->state = Item::State::Dropped;
        waiting_.clear();
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

bool WorkQueue::is_full_for(uint64_t cost) const {
    if (waiting_.empty()) return limits_.max_waiting == 0;
    return waiting_.size() >= limits_.max_waiting || cost > limits_.max_cost ||
           waiting_cost_ > limits_.max_cost - cost;
}

/// Removes waiting work from all lists.
WorkQueue::Handle WorkQueue::take_locked(std::map<Key, Handle>::iterator place) {
    Handle item = place->second;
    waiting_cost_ -= item->cost;
    clients_[item->client].waiting_cost -= item->cost;
    waiting_.erase(place);
    if (!waiting_.empty()) return item;
    // Nobody is owed anything any more.
    for (const auto& [name, client] : clients_) time_ = std::max(time_, client.finish);
    clients_.clear();
    return item;
}

/// Drops the newest work of greedier clients until there is room. Returns false if there is none.
bool WorkQueue::make_room(const std::string& client, uint64_t cost) {
    while (is_full_for(cost)) {
        const auto greediest = std::ranges::max_element(
            clients_, {}, [](const auto& entry) { return entry.second.waiting_cost; });
        const uint64_t own = clients_[client].waiting_cost + cost;
        if (greediest == clients_.end() || greediest->second.waiting_cost <= own) return false;
        const auto newest = std::find_if(
            waiting_.rbegin(), waiting_.rend(),
            [&](const auto& entry) { return entry.second->client == greediest->first; });
        if (newest == waiting_.rend()) return false;
        take_locked(std::prev(newest.base()))->state = Item::State::Dropped;
    }
    return true;
}

WorkQueue::Handle WorkQueue::post(const std::string& client, uint64_t cost,
                                  std::function<void()> work) {
    auto item = std::make_shared<Item>();
    item->client = client;
    item->cost = std::max<uint64_t>(cost, 1);
    item->work = std::move(work);
    {
        const std::lock_guard lock(mutex_);
        if (is_ending_ || !make_room(client, item->cost)) return nullptr;
        Client& owner = clients_[client];
        item->key = {std::max(time_, owner.finish), next_number_++};
        owner.finish = item->key.first + item->cost;
        owner.waiting_cost += item->cost;
        waiting_cost_ += item->cost;
        waiting_.emplace(item->key, item);
    }
    wake_.notify_one();
    return item;
}

bool WorkQueue::drop(const Handle& item) {
    const std::lock_guard lock(mutex_);
    if (item->state == Item::State::Waiting) {
        (void)take_locked(waiting_.find(item->key));
        item->state = Item::State::Dropped;
    }
    return item->state == Item::State::Dropped;
}

bool WorkQueue::is_dropped(const Handle& item) const {
    const std::lock_guard lock(mutex_);
    return item->state == Item::State::Dropped;
}

size_t WorkQueue::waiting_count() const {
    const std::lock_guard lock(mutex_);
    return waiting_.size();
}

void WorkQueue::run() {
    // In Linux niceness belongs to threads.
    if (limits_.niceness > 0) {
        ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), limits_.niceness);
    }
    while (true) {
        Handle item;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
            if (is_ending_) return;
            time_ = std::max(time_, waiting_.begin()->first.first);
            item = take_locked(waiting_.begin());
            item->state = Item::State::Begun;
        }
        item->work();
    }
}

}  // namespace tetralight::server
