// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/tokens.h>

#include <algorithm>
#include <chrono>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {

Result<std::string> parse_token(std::string text, const std::string& field,
                                const std::string& source) {
    text.erase(text.find_last_not_of(" \t\r\n") + 1);
    if (text.empty()) return Error{ErrorCode::Corrupt, field, source, source + ": is empty"};
    if (!std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~'; })) {
        return Error{ErrorCode::InvalidArgument, field, "",
                     source +
                         ": a token is letters, digits and signs of ASCII, without spaces and line "
                         "breaks"};
    }
    if (text.size() >= kShortestToken) return text;
    return Error{ErrorCode::InvalidArgument, field, "",
                 str_cat(source, ": a token has at least ", kShortestToken, " characters")};
}

bool is_same_secret(std::string_view a, std::string_view b) noexcept {
    unsigned char difference = a.size() == b.size() ? 0 : 1;
    for (size_t i = 0; i < a.size(); ++i) {
        const char other = b.empty() ? '\0' : b[i % b.size()];
        difference = static_cast<unsigned char>(difference | (a[i] ^ other));
    }
    return difference == 0;
}

namespace {

/// One token for both would let every reader change everything.
bool are_equal(const std::string& admin, const std::string& reader) {
    return !admin.empty() && is_same_secret(admin, reader);
}

}  // namespace

Result<std::unique_ptr<Tokens>> Tokens::open(const Settings& settings, Log& log) {
    std::unique_ptr<Tokens> tokens(new Tokens(log));
    tokens->admin_.token = settings.token;
    tokens->admin_.path = settings.token_file;
    tokens->reader_.path = settings.read_token_file;
    for (Source* source : {&tokens->admin_, &tokens->reader_}) {
        if (source->path.empty()) continue;
        if (auto status = read(*source); !status) return status.error();
    }
    if (are_equal(tokens->admin_.token, tokens->reader_.token)) {
        return Error{ErrorCode::InvalidArgument, "read_token_file", "",
                     tokens->reader_.path + ": holds the token that may change everything, too"};
    }
    if (tokens->admin_.token.empty() && !tokens->reader_.token.empty()) {
        log.write(Log::Level::Warning, "no token lets clients change anything");
    }
    tokens->has_any_ = !tokens->admin_.token.empty() || !tokens->reader_.token.empty();
    if (!tokens->admin_.path.empty() || !tokens->reader_.path.empty()) {
        tokens->periodic_.start(std::chrono::milliseconds(500),
                                [t = tokens.get()] { t->read_changed_files(); });
    }
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

void Tokens::read_changed_files() {
    Source admin = read_again(admin_);
    Source reader = read_again(reader_);
    if (are_equal(admin.token, reader.token)) {
        // What has changed is read again at each look: the other one may be replaced next.
        for (const auto& [last, now] : {std::pair(&admin_, &admin), std::pair(&reader_, &reader)}) {
            if (last->token == now->token) last->stamp = now->stamp;
        }
        if (!were_equal_) {
            log_.write(Log::Level::Error,
                       "both token files hold one token; the last ones stay valid",
                       {{"field", reader.field}});
        }
        were_equal_ = true;
        return;
    }
    were_equal_ = false;
    replace(admin_, std::move(admin));
    replace(reader_, std::move(reader));
}

/// The source with the token that its file has now, or with its last one if that is wrong.
Tokens::Source Tokens::read_again(const Source& source) {
    if (source.path.empty() || stamp_of(source.path) == source.stamp) return source;
    Source now{.field = source.field, .path = source.path};
    if (auto status = read(now); !status) {
        now.token = source.token;
        log_.write(Log::Level::Error, "a token could not be read; the last one stays valid",
                   {{"field", source.field}, {"error", detail_of(status.error())}});
    }
    return now;
}

/// Requests wait for no file.
void Tokens::replace(Source& source, Source now) {
    const bool is_new = now.token != source.token;
    {
        const std::lock_guard lock(mutex_);
        source = std::move(now);
    }
    if (is_new) {
        log_.write(Log::Level::Info, "a token has changed", {{"field", source.field}});
    }
}

Right Tokens::right_of(std::string_view token) {
    const std::lock_guard lock(mutex_);
    // Both are compared in any case: the time does not tell which one was close.
    const bool is_admin = is_same_secret(token, admin_.token) && !admin_.token.empty();
    const bool is_reader = is_same_secret(token, reader_.token) && !reader_.token.empty();
    return is_admin ? Right::Admin : is_reader ? Right::Read : Right::None;
}

}  // namespace tetralight::server
