// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/detail/send_response.h>

#include <algorithm>
#include <array>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <cstdio>
#include <ctime>
#include <span>

#include <tetralight/base/str_cat.h>

namespace tetralight::server {
namespace {

void append_header(std::string& head, std::string_view name, std::string_view value) {
    head.append(name).append(": ");
    for (const char c : value) head += c == '\r' || c == '\n' ? ' ' : c;
    head += "\r\n";
}

/// The time as `Date` has it: "Sun, 06 Nov 1994 08:49:37 GMT" (RFC 9110, section 5.6.7). Threads
/// format it once a second.
std::string_view date_text() {
    thread_local std::time_t last = 0;
    thread_local std::array<char, 40> text{};
    const std::time_t now = std::time(nullptr);
    if (now != last) {
        constexpr const char* kDays[] = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
        constexpr const char* kMonths[] = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                           "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
        std::tm parts = {};
        ::gmtime_r(&now, &parts);
        std::snprintf(text.data(), text.size(), "%s, %02d %s %04d %02d:%02d:%02d GMT",
                      kDays[parts.tm_wday], parts.tm_mday, kMonths[parts.tm_mon],
                      parts.tm_year + 1900, parts.tm_hour, parts.tm_min, parts.tm_sec);
        last = now;
    }
    return text.data();
}

/// The text before the body.
std::string head_of(const Request& request, const Response& response, bool keeps_open) {
    std::string head =
        str_cat("HTTP/1.1 ", response.status, " ", reason_phrase(response.status), "\r\n");
    if (!response.content_type.empty()) append_header(head, "Content-Type", response.content_type);
    append_header(head, "Date", date_text());
    append_header(head, "X-Request-Id", request.id);
    for (const auto& [name, value] : response.headers) append_header(head, name, value);
    if (response.events) {
        head += "Transfer-Encoding: chunked\r\n";
    } else if (response.status != 204 && response.status != 304) {
        append_header(head, "Content-Length", std::to_string(response.body.bytes.size()));
    }
    append_header(head, "Connection", keeps_open ? "keep-alive" : "close");
    return head + "\r\n";
}

net::awaitable<bool> send_events(Session& session, const Response& response, SendRule rule) {
    constexpr auto kPause = std::chrono::milliseconds(100);
    constexpr auto kLongestSilence = std::chrono::seconds(15);
    const auto executor = co_await net::this_coro::executor;
    net::steady_timer timer(executor);
    auto last = Clock::now();
    error_code error;
    bool goes_on = true;
    while (goes_on && !error && !rule.is_ending) {
        std::string said;
        goes_on = response.events(said);
        if (said.empty() && Clock::now() - last > kLongestSilence) said = ":\n\n";
        if (!said.empty()) {
            std::array<char, 20> length{};
            std::snprintf(length.data(), length.size(), "%zx\r\n", said.size());
            said = length.data() + said + "\r\n";
            session.stream.expires_after(to_duration(rule.seconds));
            co_await net::async_write(session.stream, net::buffer(said),
                                      net::redirect_error(net::use_awaitable, error));
            last = Clock::now();
        }
        if (!goes_on || error) break;
        timer.expires_after(kPause);
        error_code ignored;
        co_await timer.async_wait(net::redirect_error(net::use_awaitable, ignored));
    }
    constexpr std::string_view kEnd = "0\r\n\r\n";
    if (!error) {
        co_await net::async_write(session.stream, net::buffer(kEnd.data(), kEnd.size()),
                                  net::redirect_error(net::use_awaitable, error));
    }
    co_return !error;
}

}  // namespace

net::awaitable<Sent> send_response(Session& session, const Request& request,
                                   const Response& response, SendRule rule) {
    const std::string head = head_of(request, response, rule.keeps_open);
    const bool has_body = request.method != "HEAD" && !response.events;
    auto rest = has_body ? response.body.bytes : std::span<const std::byte>();
    size_t head_size = head.size();
    Sent sent;
    error_code error;
    do {
        const auto slice = rest.first(std::min(rest.size(), kSliceSize));
        const bool is_last = slice.size() == rest.size();
        if (is_last && response.is_intact && !response.is_intact()) co_return sent;
        const std::array<net::const_buffer, 2> parts{net::buffer(head.data(), head_size),
                                                     net::buffer(slice.data(), slice.size())};
        session.stream.expires_after(to_duration(rule.seconds));
        const size_t count = co_await net::async_write(
            session.stream, parts, net::redirect_error(net::use_awaitable, error));
        sent.bytes += count - std::min(count, head_size);
        rest = rest.subspan(slice.size());
        head_size = 0;
    } while (!error && !rest.empty());
    sent.is_whole = !error;
    if (sent.is_whole && response.events && request.method != "HEAD") {
        sent.is_whole = co_await send_events(session, response, rule);
    }
    co_return sent;
}

}  // namespace tetralight::server
