// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>

#include <tetralight/base/str_cat.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

struct ByteRange {
    uint64_t begin = 0;
    uint64_t end = 0;
};

/// The range of `Range: bytes=...`; nothing (send all) for several ranges or another unit.
std::optional<ByteRange> parse_range(std::string_view header, uint64_t size) {
    constexpr std::string_view kUnit = "bytes=";
    if (!header.starts_with(kUnit) || header.find(',') != std::string_view::npos) {
        return std::nullopt;
    }
    header.remove_prefix(kUnit.size());
    const size_t dash = header.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    const auto number = [](std::string_view digits) -> std::optional<uint64_t> {
        uint64_t value = 0;
        const char* end = digits.data() + digits.size();
        const auto [next, error] = std::from_chars(digits.data(), end, value);
        return error == std::errc{} && next == end ? std::optional(value) : std::nullopt;
    };
    const std::string_view first = header.substr(0, dash);
    const std::string_view last = header.substr(dash + 1);
    if (first.empty()) {  // the last bytes
        const auto count = number(last);
        if (!count) return std::nullopt;
        return ByteRange{size - std::min(*count, size), size};
    }
    const auto begin = number(first);
    const auto end = last.empty() ? std::optional(UINT64_MAX) : number(last);
    if (!begin || !end || *end < *begin) return std::nullopt;
    return ByteRange{*begin, *end < size ? *end + 1 : size};
}

}  // namespace

Response bytes_response(const Request& request, const Body& body, const std::string& content_type,
                        const std::string& tag) {
    const std::string quoted = "\"" + tag + "\"";
    // The bytes of an id never change; a name may later lead to other bytes.
    const bool is_by_id = is_id(request.captures[0]);
    Response response{
        .content_type = content_type,
        .headers = {{"ETag", quoted},
                    {"Accept-Ranges", "bytes"},
                    {"Cache-Control",
                     is_by_id ? "private, max-age=31536000, immutable" : "private, no-cache"}},
        .body = body};
    if (has_tag(request.header("if-none-match"), quoted, TagComparison::Weak)) {
        response.status = 304;
        response.body = {};
        return response;
    }
    const std::string_view condition = request.header("if-range");
    const uint64_t size = body.bytes.size();
    const auto range = parse_range(request.header("range"), size);
    if (!range || (!condition.empty() && condition != quoted)) return response;
    if (range->begin >= size || range->begin >= range->end) {
        throw Problem{416,
                      "invalid_range",
                      str_cat("there are ", size, " bytes"),
                      "range",
                      std::string(request.header("range")),
                      {{"Content-Range", str_cat("bytes */", size)}}};
    }
    response.status = 206;
    response.headers.emplace_back("Content-Range",
                                  str_cat("bytes ", range->begin, "-", range->end - 1, "/", size));
    response.body.bytes = body.bytes.subspan(range->begin, range->end - range->begin);
    return response;
}

}  // namespace tetralight::server
