// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/log.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>

#include <tetralight/base/str_cat.h>

namespace tetralight::server {
namespace {

/// Lines that wait for the thread; more are dropped.
constexpr size_t kMostPending = 1 << 20;

/// "2026-01-31T12:00:00.123Z"
std::string now_text() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
    const auto seconds = static_cast<std::time_t>(milliseconds / 1000);
    std::tm parts = {};
    ::gmtime_r(&seconds, &parts);
    std::array<char, 64> date{};
    std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%S", &parts);
    std::array<char, 96> all{};
    std::snprintf(all.data(), all.size(), "%s.%03dZ", date.data(),
                  static_cast<int>(milliseconds % 1000));
    return all.data();
}

const char* name_of(Log::Level level) {
    constexpr const char* kNames[] = {"debug", "info", "warning", "error", ""};
    return kNames[static_cast<size_t>(level)];
}

}  // namespace

Log::Log(Level least) : least_(least), thread_([this] { run(); }) {}

Log::~Log() {
    {
        const std::lock_guard lock(mutex_);
        is_ending_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void Log::write(Level level, std::string_view message, const Json& members) {
    if (!is_shown(level)) return;
    Json json{{"time", now_text()}, {"level", name_of(level)}, {"message", message}};
    json.update(members);
    append(level, dump(json) + "\n");
}

void Log::request(const Exchange& exchange) {
    const auto& [request, route, status, sent_bytes, seconds, waited, is_aborted] = exchange;
    const Level level = status >= 500 ? Level::Warning : Level::Info;
    if (!is_shown(level)) return;
    // Formatted by hand because every request needs it. Only the path may need escaping.
    append(
        level,
        str_cat(R"({"time":")", now_text(), R"(","level":")", name_of(level),
                R"(","message":"request","request_id":")", request.id, R"(","method":")",
                request.method, R"(","path":)", dump(Json(request.path)), R"(,"status":)", status,
                R"(,"received":)", request.body_size, R"(,"sent":)", sent_bytes, R"(,"ms":)",
                static_cast<double>(static_cast<int64_t>(seconds * 1e6)) / 1e3, R"(,"remote":")",
                request.remote, '"', is_aborted ? R"(,"aborted":true)" : "", "}\n"));
}

void Log::append(Level level, const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (pending_.size() + line.size() > kMostPending) {
        ++dropped_count_;
        return;
    }
    pending_ += line;
    if (level < Level::Warning && pending_.size() < kMostPending / 4) return;
    is_urgent_ = true;
    wake_.notify_one();
}

/// Takes the pending lines if all earlier ones are written, and reports what was dropped since.
void Log::take_pending_locked() {
    if (!unwritten_.empty()) return;
    unwritten_.swap(pending_);
    const uint64_t dropped = dropped_count_;
    if (dropped == reported_count_) return;
    const Json json{{"time", now_text()},
                    {"level", name_of(Level::Warning)},
                    {"message", "lines of the log were dropped because stderr was not read"},
                    {"count", dropped - reported_count_}};
    unwritten_ += dump(json) + "\n";
    reported_count_ = dropped;
}

void Log::run() {
    constexpr auto kPause = std::chrono::milliseconds(100);
    bool is_last = false;
    while (!is_last) {
        {
            std::unique_lock lock(mutex_);
            // While stderr takes nothing, urgent lines must not make this thread spin.
            wake_.wait_for(lock, kPause,
                           [this] { return is_ending_ || (is_urgent_ && unwritten_.empty()); });
            is_urgent_ = false;
            is_last = is_ending_;
            take_pending_locked();
        }
        unwritten_.erase(0, output_.write(unwritten_));
    }
    // What came while earlier lines were written.
    const std::lock_guard lock(mutex_);
    take_pending_locked();
    (void)output_.write(unwritten_);
}

}  // namespace tetralight::server
