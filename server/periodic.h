// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace tetralight::server {

/// Work that a thread of its own repeats. Declare it after everything that the work uses: the
/// thread ends with this object, after the work in progress.
class Periodic {
  public:
    Periodic() = default;
    Periodic(const Periodic&) = delete;
    Periodic& operator=(const Periodic&) = delete;
    ~Periodic();

    /// Runs `work` after each pause. It may throw `std::bad_alloc`, as the next pause may bring
    /// memory, and nothing else. Precondition: not called before.
    void start(std::chrono::duration<double> pause, std::function<void()> work);

    /// Ends the current pause.
    void wake();

  private:
    void run(std::chrono::duration<double> pause, const std::function<void()>& work);

    std::mutex mutex_;
    std::condition_variable changed_;
    bool is_awake_ = false;
    bool is_ending_ = false;
    std::thread thread_;
};

}  // namespace tetralight::server
