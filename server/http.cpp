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

std::string_view trimmed(std::string_view text) {
    const size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
    return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

/// Calls `use` for each element of a list with commas.
template <class Use>
void for_each_element(std::string_view list, Use use) {
    while (!list.empty()) {
        const std::string_view element = list.substr(0, list.find(','));
        use(trimmed(element));
        list.remove_prefix(std::min(element.size() + 1, list.size()));
    }
}

/// Reads the segments of a path. Returns false if one cannot be decoded.
bool parse_path(std::string_view path, Request& request) {
    while (!path.empty()) {
        path.remove_prefix(1);  // the slash
        const std::string_view sent = path.substr(0, path.find('/'));
        auto decoded = percent_decoded(sent);
        if (!decoded) return false;
        request.path += '/' + *decoded;
        request.segments.push_back({std::string(sent), std::move(*decoded)});
        path.remove_prefix(sent.size());
    }
    return true;
}

}  // namespace

std::string_view Request::header(std::string_view name) const {
    const auto found =
        std::ranges::find(headers, name, &std::pair<std::string, std::string>::first);
    return found == headers.end() ? std::string_view() : found->second;
}

bool Request::has_header(std::string_view name) const {
    return std::ranges::find(headers, name, &std::pair<std::string, std::string>::first) !=
           headers.end();
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

bool has_tag(std::string_view list, std::string_view tag, TagComparison comparison) {
    bool found = trimmed(list) == "*";
    // The server's own tags have no commas, so the parts of others with commas differ from them.
    for_each_element(list, [&](std::string_view element) {
        const bool is_weak = element.starts_with("W/");
        if (is_weak && comparison == TagComparison::Weak) element.remove_prefix(2);
        found |= element == tag;
    });
    return found;
}

bool accepts_gzip(std::string_view accept_encoding) {
    bool is_accepted = false;
    bool is_named = false;
    for_each_element(accept_encoding, [&](std::string_view element) {
        const size_t semicolon = std::min(element.find(';'), element.size());
        const std::string_view coding = trimmed(element.substr(0, semicolon));
        std::string_view weight = element.substr(semicolon);
        weight.remove_prefix(std::min(weight.find('=') + 1, weight.size()));
        const bool is_zero = !weight.empty() && weight.find_first_of("123456789") == weight.npos;
        const bool is_gzip = std::ranges::equal(coding, std::string_view("gzip"), {}, to_lower);
        if (is_gzip || (coding == "*" && !is_named)) is_accepted = !is_zero;
        is_named |= is_gzip;
    });
    return is_accepted;
}

std::string_view reason_phrase(unsigned status) {
    const auto reason =
        boost::beast::http::obsolete_reason(static_cast<boost::beast::http::status>(status));
    return {reason.data(), reason.size()};
}

bool parse_target(std::string_view target, Request& request) {
    if (!target.starts_with('/')) return false;
    const size_t question = std::min(target.find('?'), target.size());
    if (!parse_path(target.substr(0, question), request)) return false;
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
