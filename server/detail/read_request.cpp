// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/detail/read_request.h>

#include <algorithm>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/read.hpp>
#include <limits>
#include <span>
#include <utility>

#include <tetralight/base/process/descriptor_io.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::server {
namespace {

namespace http = beast::http;

std::string lower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), to_lower);
    return result;
}

bool is_request_id(std::string_view id) {
    constexpr size_t kLongest = 64;
    const auto is_plain = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '-' || c == '_' || c == '.';
    };
    return !id.empty() && id.size() <= kLongest && std::ranges::all_of(id, is_plain);
}

bool is_http_error(const error_code& error) {
    return error.category() == http::make_error_code(http::error::bad_method).category();
}

/// The printable beginning of what the client sent.
std::string beginning(const beast::flat_buffer& buffer) {
    constexpr size_t kMost = 40;
    const auto bytes = buffer.data();
    const std::string_view all(static_cast<const char*>(bytes.data()), bytes.size());
    return std::string(all.substr(0, std::min(all.find('\r'), kMost)));
}

/// Why a head could not be read; nothing if the client has disconnected.
std::optional<Problem> problem_of_head(const Settings& settings, const Session& session,
                                       const error_code& error) {
    if (error == http::error::header_limit) {
        return Problem{431, "header_too_large", "the request's head is too large", "head",
                       str_cat("more than ", settings.max_header_bytes, " bytes")};
    }
    if (session.is_late) {
        return Problem{
            408, "too_slow",
            str_cat("the request's head did not come in ", settings.header_seconds, " s"), "head",
            beginning(session.buffer)};
    }
    if (error == http::error::end_of_stream || error == http::error::partial_message ||
        !is_http_error(error)) {
        return std::nullopt;
    }
    return Problem{400, "malformed_request", "is no HTTP/1.1: " + error.message(), "head",
                   beginning(session.buffer)};
}

/// What a chunked body may have besides its bytes: sizes, extensions and trailers. Each byte of the
/// body may have a chunk of its own, of six bytes.
uint64_t framing_limit(const Settings& settings, uint64_t body_size) {
    constexpr uint64_t kForEachByte = 8;
    return settings.max_header_bytes + kForEachByte * body_size;
}

Problem too_much_framing(const std::string& came) {
    return {431, "header_too_large", "the body has too many chunk extensions or trailers", "body",
            came};
}

constexpr size_t kLongestValue = 200;
constexpr unsigned kHttp11 = 11;

/// Refuses transfer codings other than `chunked` alone, and those of HTTP/1.0 or beside a
/// Content-Length: a proxy may find another end of such a body (RFC 9112, sections 6.1 and 6.3).
std::optional<Problem> check_framing(const Parser::value_type& message) {
    const auto count = message.count(http::field::transfer_encoding);
    if (count == 0) return std::nullopt;
    const std::string coding(message[http::field::transfer_encoding]);
    const bool is_chunked = count == 1 && lower(coding) == "chunked";
    const bool has_length = message.count(http::field::content_length) > 0;
    if (is_chunked && !has_length && message.version() >= kHttp11) return std::nullopt;
    return Problem{
        400, "malformed_request",
        has_length ? "Transfer-Encoding and Content-Length exclude each other"
                   : "the only transfer coding is chunked, given once, in a request of HTTP/1.1",
        "transfer-encoding", coding.substr(0, kLongestValue)};
}

/// Converts the head to a plain value and checks it.
std::optional<Problem> take_head(const Parser& parser, Request& request) {
    const auto& message = parser.get();
    request.method = std::string(message.method_string());
    for (const auto& field : message) {
        request.headers.emplace_back(
            lower({field.name_string().data(), field.name_string().size()}),
            std::string(field.value()));
    }
    const std::string_view id = request.header("x-request-id");
    if (is_request_id(id)) request.id = id;
    const auto host_count = message.count(http::field::host);
    if (host_count > 1 || (host_count == 0 && message.version() >= kHttp11)) {
        return Problem{400, "malformed_request", "HTTP/1.1 needs one Host header", "host",
                       std::string(request.header("host").substr(0, kLongestValue))};
    }
    if (auto problem = check_framing(message)) return problem;
    const auto target = message.target();
    if (parse_target({target.data(), target.size()}, request)) return std::nullopt;
    return Problem{400, "malformed_request", "the target is no path", "target",
                   std::string(target.substr(0, kLongestValue))};
}

Reading refusal(Problem problem) {
    return {.is_whole = false, .refused = std::move(problem)};
}

/// The bytes of one step of reading a body, and those of its framing.
struct Slice {
    size_t body_bytes = 0;
    uint64_t framing_bytes = 0;
    error_code error;
};

/// Reads until `target` is full or the body ends. Chunks are read one at a time, so that at most
/// `most_framing` bytes and one buffer come besides the body.
net::awaitable<Slice> read_slice(Session& session, Parser& parser, std::span<char> target,
                                 uint64_t most_framing) {
    auto& body = parser.get().body();
    body.data = target.data();
    body.size = target.size();
    Slice slice;
    if (!parser.chunked()) {
        co_await http::async_read(session.stream, session.buffer, parser,
                                  net::redirect_error(net::use_awaitable, slice.error));
    } else {
        uint64_t all = 0;
        while (!slice.error && !parser.is_done() && slice.framing_bytes <= most_framing) {
            const size_t count = co_await http::async_read_some(
                session.stream, session.buffer, parser,
                net::redirect_error(net::use_awaitable, slice.error));
            all += count;
            slice.framing_bytes = all - (target.size() - body.size);
        }
    }
    if (slice.error == http::error::need_buffer) slice.error = {};
    slice.body_bytes = target.size() - body.size;
    co_return slice;
}

}  // namespace

net::awaitable<Reading> read_head(Session& session, Parser& parser, const Settings& settings,
                                  Request& request) {
    session.buffer.max_size(std::max<size_t>(kReadSize, settings.max_header_bytes));
    parser.header_limit(settings.max_header_bytes);
    parser.body_limit(std::numeric_limits<uint64_t>::max());  // each route has its own
    error_code error;
    session.arm(settings.header_seconds);
    co_await http::async_read_header(session.stream, session.buffer, parser,
                                     net::redirect_error(net::use_awaitable, error));
    session.disarm();
    Reading reading;
    reading.refused =
        error ? problem_of_head(settings, session, error) : take_head(parser, request);
    reading.is_whole = !error && !reading.refused;
    co_return reading;
}

net::awaitable<Reading> read_body(Session& session, Parser& parser, const Settings& settings,
                                  const Plan& plan, Request& request) {
    Reading reading;
    if (plan.ignores_body) {
        reading.is_whole = true;
        co_return reading;
    }
    const auto too_large = [&](const std::string& size) {
        return refusal({413, "too_large",
                        str_cat("the body is larger than ", plan.body_limit, " bytes"), "body",
                        size});
    };
    const auto length = parser.content_length();
    if (length && *length > plan.body_limit) co_return too_large(str_cat(*length, " bytes"));
    parser.body_limit(plan.body_limit);  // for chunks
    beast::tcp_stream& stream = session.stream;
    error_code error;
    if (lower(request.header("expect")) == "100-continue") {
        constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
        co_await net::async_write(stream, net::buffer(kContinue.data(), kContinue.size()),
                                  net::redirect_error(net::use_awaitable, error));
    }
    const bool is_to_file = plan.body_to == Plan::BodyTo::File;
    std::string& body = request.body;
    uint64_t framing = 0;
    while (!error && !parser.is_done()) {
        // Allocate for received bytes, not for announced ones.
        const size_t begin = is_to_file ? 0 : body.size();
        const size_t room =
            length ? std::min<uint64_t>(kSliceSize, *length - request.body_size) : kSliceSize;
        body.resize(begin + room);
        session.arm(settings.transfer_seconds);
        const uint64_t limit = framing_limit(settings, request.body_size + room);
        const Slice slice =
            co_await read_slice(session, parser, {body.data() + begin, room}, limit - framing);
        session.disarm();
        error = slice.error;
        framing += slice.framing_bytes;
        const size_t count = slice.body_bytes;
        request.body_size += count;
        body.resize(begin + count);
        if (framing > framing_limit(settings, request.body_size)) {
            co_return refusal(too_much_framing(str_cat(framing, " bytes")));
        }
        if (is_to_file &&
            !write_all(request.body_file, std::as_bytes(std::span(body.data(), count)))) {
            co_return refusal({507, "disk_full", "the body could not be stored", "body",
                               str_cat(request.body_size, " bytes")});
        }
    }
    if (is_to_file) body.clear();
    const std::string came = str_cat(request.body_size, " bytes");
    if (error == http::error::body_limit) co_return too_large("more than " + came);
    if (error == http::error::buffer_overflow) {
        co_return refusal(too_much_framing(str_cat("more than ", kReadSize, " bytes")));
    }
    reading.is_whole = !error;
    if (session.is_late) {
        reading.refused =
            Problem{408, "too_slow",
                    str_cat("no 64 KiB of the body came in ", settings.transfer_seconds, " s"),
                    "body", came};
    } else if (is_http_error(error) && error != http::error::partial_message &&
               error != http::error::end_of_stream) {
        reading.refused =
            Problem{400, "malformed_request", "the body: " + error.message(), "body", came};
    }
    co_return reading;
}

}  // namespace tetralight::server
