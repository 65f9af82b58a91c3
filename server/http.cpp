// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/http.h>

#include <algorithm>
#include <boost/beast/http/status.hpp>
#include <charconv>
#include <optional>

#include <tetralight/base/utf8.h>

namespace tetralight::server {
namespace {

std::optional<std::string> percent_decoded(std::string_view text) {
    std::string decoded;
    for (size_t i = 0; i < text.size(); ++i) {
        char c = text[i];
        if (c == '%') {
            if (text.size() - i < 3) return std::nullopt;
            const char* digits = text.data() + i + 1;
            unsigned code = 0;
            if (std::from_chars(digits, digits + 2, code, 16).ptr != digits + 2) {
                return std::nullopt;
            }
            c = static_cast<char>(code);
            i += 2;
        }
        const auto byte = static_cast<unsigned char>(c);
        if (byte < ' ' || byte == 0x7f) return std::nullopt;
        decoded += c;
    }
    if (!is_utf8(decoded)) return std::nullopt;
    return decoded;
}

}  // namespace

std::string_view Request::header(std::string_view name) const {
    const auto found =
        std::ranges::find(headers, name, &std::pair<std::string, std::string>::first);
    return found == headers.end() ? std::string_view() : found->second;
}

bool Request::has_type(std::string_view type) const {
    std::string_view own = header("content-type");
    own = own.substr(0, own.find(';'));
    own = own.substr(0, own.find_last_not_of(" \t") + 1);
    return std::ranges::equal(own, type, {}, to_lower, to_lower);
}

const std::string* Request::parameter(std::string_view name) const {
    const auto found =
        std::ranges::find(parameters, name, &std::pair<std::string, std::string>::first);
    return found == parameters.end() ? nullptr : &found->second;
}

Body::Body(std::string text) {
    const auto kept = std::make_shared<const std::string>(std::move(text));
    bytes = std::as_bytes(std::span(*kept));
    owner = kept;
}

Body::Body(std::vector<std::byte> data) {
    const auto kept = std::make_shared<const std::vector<std::byte>>(std::move(data));
    bytes = *kept;
    owner = kept;
}

std::string_view reason_phrase(unsigned status) {
    const auto reason =
        boost::beast::http::obsolete_reason(static_cast<boost::beast::http::status>(status));
    return {reason.data(), reason.size()};
}

bool parse_target(std::string_view target, Request& request) {
    if (!target.starts_with('/')) return false;
    const size_t question = std::min(target.find('?'), target.size());
    auto path = percent_decoded(target.substr(0, question));
    if (!path) return false;
    request.path = std::move(*path);
    std::string_view rest = target.substr(std::min(question + 1, target.size()));
    while (!rest.empty()) {
        const std::string_view part = rest.substr(0, rest.find('&'));
        const size_t equals = std::min(part.find('='), part.size());
        auto name = percent_decoded(part.substr(0, equals));
        auto value = percent_decoded(part.substr(std::min(equals + 1, part.size())));
        if (!name || !value) return false;
        request.parameters.emplace_back(std::move(*name), std::move(*value));
        rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    }
    return true;
}

}  // namespace tetralight::server
