// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include <tetralight/server/detail/log_output.h>
#include <tetralight/server/json.h>

namespace tetralight::server {

/// Lines of JSON on stderr, one per event. A thread writes them: lines of requests after a tenth of
/// a second, to save system calls, warnings and errors at once. Nobody waits for it: if stderr is a
/// pipe that its reader does not empty, new lines are dropped and counted, and a line reports their
/// number once stderr takes more.
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

    /// Lines that were dropped since the start.
    [[nodiscard]] uint64_t dropped_count() const { return dropped_count_; }

  private:
    void append(Level level, const std::string& line);
    void run();
    void take_pending_locked();

    const Level least_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::string pending_;
    bool is_urgent_ = false;
    bool is_ending_ = false;
    std::atomic<uint64_t> dropped_count_ = 0;
    uint64_t reported_count_ = 0;  ///< dropped lines that a line of the log has reported
    // Used by the thread alone.
    std::string unwritten_;
    LogOutput output_;
    std::thread thread_;
};

}  // namespace tetralight::server
