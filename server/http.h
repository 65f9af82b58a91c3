// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tetralight/base/process/descriptor.h>

// Requests and responses as plain values. Handlers see only these; sockets and the HTTP library are
// hidden behind http_server.h.

namespace tetralight::server {

/// A part of a path between slashes. "%6Dy" and "my" are the same name, but only the second one
/// matches a rule of a proxy about "my".
struct PathSegment {
    std::string sent;
    std::string decoded;
};

struct Request {
    /// For logs, and for the client: `X-Request-Id`.
    std::string id;
    std::string method;
    /// Percent-decoded, without the query string. For logs and messages: an encoded slash looks
    /// like one that separates segments.
    std::string path;
    /// The path as it was sent, between its slashes.
    std::vector<PathSegment> segments;
    /// The decoded query string, in its order.
    std::vector<std::pair<std::string, std::string>> parameters;
    /// Names in lower case.
    std::vector<std::pair<std::string, std::string>> headers;
    /// The parts of the path that the route's pattern captures.
    std::vector<std::string> captures;
    std::string body;
    /// Holds the body instead, if the route asks for a file.
    Descriptor body_file;
    uint64_t body_size = 0;
    std::string remote;
    /// An object that a route keeps from the head of the request until its end.
    std::shared_ptr<void> work;
    /// The client has disconnected. Set while a worker handles the request.
    std::atomic<bool> is_abandoned = false;

    /// Empty if it was not sent.
    [[nodiscard]] std::string_view header(std::string_view name) const;

    /// True if the body has this media type; its parameters do not matter.
    [[nodiscard]] bool has_type(std::string_view type) const;

    [[nodiscard]] bool has_header(std::string_view name) const;

    /// Null if it was not sent.
    [[nodiscard]] const std::string* parameter(std::string_view name) const;
};

/// Bytes to send, and an owner that keeps them in memory until then.
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
    /// If set, the body is server-sent events. Called a few times a second: appends new events and
    /// returns false after the last one.
    std::function<bool(std::string&)> events = {};
    /// If set, it is called before the last bytes are sent. If it returns false, the connection is
    /// closed instead, so that the client sees that the answer is not whole.
    std::function<bool()> is_intact = {};
};

/// How to handle a request, decided from its head.
struct Plan {
    enum class BodyTo : uint8_t { Memory, File };
    enum class RunOn : uint8_t {
        Network,  ///< answers at once; long bodies are handled by `Compute`
        Compute,  ///< needs a processor for a time
        Storage,  ///< stores, deletes and checks; may wait for disks and short programs
        Tools,    ///< waits for programs that may take minutes
    };

    /// The pattern of the path, for logs and metrics.
    std::string route;
    uint64_t body_limit = 0;
    BodyTo body_to = BodyTo::Memory;
    RunOn run_on = RunOn::Network;
    std::function<Response(Request&)> handle;
    /// The answer does not depend on the body.
    bool ignores_body = false;
};

/// One answered request.
struct Exchange {
    const Request& request;
    const std::string& route;
    unsigned status = 0;
    uint64_t sent_bytes = 0;
    double seconds = 0.0;
    /// Time for which it waited for a worker; nothing if it needed none.
    std::optional<double> wait_seconds = {};
    /// The client disconnected or was too slow before all was sent.
    bool is_aborted = false;
};

/// For ASCII letters only, in every locale.
[[nodiscard]] constexpr char to_lower(char c) noexcept {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

enum class TagComparison : uint8_t {
    Weak,    ///< for `If-None-Match`: W/"a" is "a"
    Strong,  ///< for `If-Match`: W/"a" is no tag
};

/// True if a list of entity tags, as `If-None-Match` and `If-Match` have it, holds this one or is
/// "*" (RFC 9110, section 13.1). `tag` has its quotes.
[[nodiscard]] bool has_tag(std::string_view list, std::string_view tag, TagComparison comparison);

/// True if the value of `Accept-Encoding` allows gzip.
[[nodiscard]] bool accepts_gzip(std::string_view accept_encoding);

/// "Not Found" for 404.
[[nodiscard]] std::string_view reason_phrase(unsigned status);

/// Reads the path and the parameters of a request target. Splits the path before it decodes the
/// segments, so that "%2F" is part of a name. Returns false if it is not an absolute
/// path, or if its escapes are incomplete or decode to control characters or invalid UTF-8.
[[nodiscard]] bool parse_target(std::string_view target, Request& request);

}  // namespace tetralight::server
