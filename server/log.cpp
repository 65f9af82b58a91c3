// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/log.h>

#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <ctime>

#include <tetralight/base/str_cat.h>

namespace tetralight::server {
namespace {

constexpr size_t kMostPending = 1 << 16;

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

/// Errors are ignored: there is no other place to report them.
void write_all(std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(STDERR_FILENO, text.data(), text.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return;
        text.remove_prefix(static_cast<size_t>(count));
    }
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
    const auto& [request, route, status, sent_bytes, seconds, is_aborted] = exchange;
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

void Log::append(Level level, std::string line) {
    std::unique_lock lock(mutex_);
    pending_ += line;
    if (level >= Level::Warning || pending_.size() > kMostPending) flush_locked(lock);
}

void Log::run() {
    std::unique_lock lock(mutex_);
    while (!is_ending_) {
        wake_.wait_for(lock, std::chrono::milliseconds(100), [this] { return is_ending_; });
        flush_locked(lock);
    }
}

void Log::flush_locked(std::unique_lock<std::mutex>&) {
    write_all(pending_);
    pending_.clear();
}

}  // namespace tetralight::server
