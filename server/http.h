// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tetralight/base/descriptor.h>

// Requests and responses as plain values. Handlers see these alone; the sockets and the library
// that parses HTTP are behind http_server.h.

namespace tetralight::server {

struct Request {
    /// For logs, and for the client: `X-Request-Id`.
    std::string id;
    std::string method;
    /// Percent-decoded, without what follows `?`.
    std::string path;
    /// What follows `?`, decoded, in its order.
    std::vector<std::pair<std::string, std::string>> parameters;
    /// Names in lower case.
    std::vector<std::pair<std::string, std::string>> headers;
    /// What the route's pattern captured of the path.
    std::vector<std::string> captures;
    std::string body;
    /// Holds the body instead, when the route says so.
    Descriptor body_file;
    uint64_t body_size = 0;
    std::string remote;
    /// What a route keeps from the head of the request until its end.
    std::shared_ptr<void> work;
    /// Nobody waits for the answer any more. Set while a worker makes it.
    std::atomic<bool> is_abandoned = false;

    /// Empty: it was not sent.
    [[nodiscard]] std::string_view header(std::string_view name) const;

    /// Whether the body says that it is of a type, whatever parameters follow it.
    [[nodiscard]] bool has_type(std::string_view type) const;

    /// Null: it is not there.
    [[nodiscard]] const std::string* parameter(std::string_view name) const;
};

/// Bytes to send, and what keeps them in memory until they are.
struct Body {
    std::span<const std::byte> bytes = {};
    std::shared_ptr<const void> owner = {};

    Body() = default;
    Body(std::string text);
    Body(std::vector<std::byte> data);

    Body(std::span<const std::byte> kept, std::shared_ptr<const void> keeper)
        : bytes(kept), owner(std::move(keeper)) {}
};

struct Response {
    unsigned status = 200;
    std::string content_type = "application/json";
    std::vector<std::pair<std::string, std::string>> headers = {};
    Body body = {};
    /// Not empty: server-sent events. Called a few times a second, it appends what there is to say,
    /// and returns false after the last of it.
    std::function<bool(std::string&)> events = {};
};

/// What a request will take, told from its head alone.
struct Plan {
    enum class BodyTo : uint8_t { Memory, File };
    enum class RunOn : uint8_t {
        Network,  ///< answers at once
        Workers,  ///< may wait for disks and programs
    };

    /// The pattern of the path, for logs and metrics.
    std::string route;
    uint64_t body_limit = 0;
    BodyTo body_to = BodyTo::Memory;
    RunOn run_on = RunOn::Network;
    std::function<Response(Request&)> handle;
    /// The answer is known without the body.
    bool ignores_body = false;
};

/// One answered request.
struct Exchange {
    const Request& request;
    const std::string& route;
    unsigned status = 0;
    uint64_t sent_bytes = 0;
    double seconds = 0.0;
    /// The client went away, or was too slow, before all was sent.
    bool is_aborted = false;
};

/// ASCII alone, whatever the locale.
[[nodiscard]] constexpr char to_lower(char c) noexcept {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// "Not Found" for 404.
[[nodiscard]] std::string_view reason_phrase(unsigned status);

/// The path and the parameters of a request target, percent-decoded. False: it is no plain path, or
/// holds escapes that decode to nothing, to a control character or to no UTF-8.
[[nodiscard]] bool parse_target(std::string_view target, Request& request);

}  // namespace tetralight::server
