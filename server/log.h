// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include <tetralight/server/json.h>

namespace tetralight::server {

/// Lines of JSON on stderr, one per event. Lines of requests are collected for a tenth of a second
/// to save system calls; warnings and errors are written at once.
class Log {
  public:
    enum class Level { Debug, Info, Warning, Error, Nothing };

    explicit Log(Level least);
    ~Log();
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;

    void write(Level level, std::string_view message, const Json& members = Json::object());

    void request(const Exchange& exchange);

    [[nodiscard]] bool is_shown(Level level) const { return level >= least_; }

  private:
    void append(Level level, std::string line);
    void run();
    void flush_locked(std::unique_lock<std::mutex>& lock);

    const Level least_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::string pending_;
    bool is_ending_ = false;
    std::thread thread_;
};

}  // namespace tetralight::server
