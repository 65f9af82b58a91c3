// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/periodic.h>

#include <new>
#include <utility>

namespace tetralight::server {

Periodic::~Periodic() {
    {
        const std::lock_guard lock(mutex_);
        is_ending_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Periodic::start(std::chrono::duration<double> pause, std::function<void()> work) {
    thread_ = std::thread([this, pause, work = std::move(work)] { run(pause, work); });
}

void Periodic::wake() {
    {
        const std::lock_guard lock(mutex_);
        is_awake_ = true;
    }
    changed_.notify_all();
}

void Periodic::run(std::chrono::duration<double> pause, const std::function<void()>& work) {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait_for(lock, pause, [&] { return is_awake_ || is_ending_; });
        if (is_ending_) return;
        is_awake_ = false;
        lock.unlock();
        try {
            work();
        } catch (const std::bad_alloc&) {
        }
        lock.lock();
    }
}

}  // namespace tetralight::server
