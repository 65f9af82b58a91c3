// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/tokens.h>

#include <sys/stat.h>

#include <algorithm>
#include <chrono>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

/// Changes when a file is written or replaced; empty if there is none.
std::string stamp_of(const std::string& path) {
    struct stat facts = {};
    if (::stat(path.c_str(), &facts) != 0) return {};
    return str_cat(facts.st_dev, ".", facts.st_ino, ".", facts.st_size, ".", facts.st_mtim.tv_sec,
                   ".", facts.st_mtim.tv_nsec, ".", facts.st_ctim.tv_sec, ".",
                   facts.st_ctim.tv_nsec);
}

}  // namespace

Result<std::string> parse_token(std::string text, const std::string& field,
                                const std::string& source) {
    text.erase(text.find_last_not_of(" \t\r\n") + 1);
    if (text.empty()) return Error{ErrorCode::Corrupt, field, source, source + ": is empty"};
    if (std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~'; })) return text;
    return Error{ErrorCode::InvalidArgument, field, "",
                 source +
                     ": a token is letters, digits and signs of ASCII, without spaces and line "
                     "breaks"};
}

bool is_same_secret(std::string_view a, std::string_view b) noexcept {
    unsigned char difference = a.size() == b.size() ? 0 : 1;
    for (size_t i = 0; i < a.size(); ++i) {
        const char other = b.empty() ? '\0' : b[i % b.size()];
        difference = static_cast<unsigned char>(difference | (a[i] ^ other));
    }
    return difference == 0;
}

Result<std::unique_ptr<Tokens>> Tokens::open(const Settings& settings, Log& log) {
    std::unique_ptr<Tokens> tokens(new Tokens(log));
    tokens->admin_.token = settings.token;
    tokens->admin_.path = settings.token_file;
    tokens->reader_.path = settings.read_token_file;
    for (Source* source : {&tokens->admin_, &tokens->reader_}) {
        if (source->path.empty()) continue;
        if (auto status = read(*source); !status) return status.error();
    }
    tokens->has_any_ = !tokens->admin_.token.empty() || !tokens->reader_.token.empty();
    return tokens;
}

Status Tokens::read(Source& source) {
    // Taken before reading: a change in between is found at the next look.
    source.stamp = stamp_of(source.path);
    const auto bytes = read_file(source.path);
    if (!bytes) return bytes.error();
    auto token = parse_token({reinterpret_cast<const char*>(bytes->data()), bytes->size()},
                             source.field, source.path);
    if (!token) return token.error();
    source.token = std::move(*token);
    return Ok{};
}

void Tokens::read_changed_file(Source& source) {
    if (source.path.empty() || stamp_of(source.path) == source.stamp) return;
    const std::string earlier = source.token;
    if (auto status = read(source); !status) {
        log_.write(Log::Level::Error, "a token could not be read; the last one stays valid",
                   {{"field", source.field}, {"error", detail_of(status.error())}});
    } else if (source.token != earlier) {
        log_.write(Log::Level::Info, "a token has changed", {{"field", source.field}});
    }
}

/// Looks at the files at most once a second.
void Tokens::read_changed_files() {
    constexpr int64_t kPause = 1'000'000'000;
    const int64_t now = std::chrono::steady_clock::now().time_since_epoch().count();
    int64_t due = next_look_;
    if (now < due || !next_look_.compare_exchange_strong(due, now + kPause)) return;
    const std::lock_guard lock(mutex_);
    read_changed_file(admin_);
    read_changed_file(reader_);
}

Right Tokens::right_of(std::string_view token) {
    read_changed_files();
    const std::lock_guard lock(mutex_);
    // Both are compared in any case: the time does not tell which one was close.
    const bool is_admin = is_same_secret(token, admin_.token) && !admin_.token.empty();
    const bool is_reader = is_same_secret(token, reader_.token) && !reader_.token.empty();
    return is_admin ? Right::Admin : is_reader ? Right::Read : Right::None;
}

}  // namespace tetralight::server
