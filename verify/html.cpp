// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/html.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>

namespace tetralight {
namespace {

/// Length of the character that begins a text, 1 to 4; 0 if its first byte does not begin one.
size_t character_length(std::string_view text) {
    for (size_t length = 1; length <= std::min<size_t>(4, text.size()); ++length) {
        if (is_utf8(text.substr(0, length))) return length;
    }
    return 0;
}

std::string valid_utf8(std::string_view text) {
    if (is_utf8(text)) return std::string(text);
    std::string valid;
    while (!text.empty()) {
        const size_t length = character_length(text);
        valid += length > 0 ? text.substr(0, length) : "\xef\xbf\xbd";
        text.remove_prefix(std::max<size_t>(length, 1));
    }
    return valid;
}

std::string printed(double number, const char* format, int digits) {
    char text[64];
    std::snprintf(text, sizeof text, format, digits, number);
    return text;
}

}  // namespace

std::string escape_html(std::string_view text) {
    std::string escaped;
    for (const char c : without_controls(valid_utf8(text))) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            case '\'':
                escaped += "&#39;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

std::string data_uri(std::string_view type, std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string uri = str_cat("data:", type, ";base64,");
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t count = std::min<size_t>(3, bytes.size() - i);
        uint32_t bits = 0;
        for (size_t k = 0; k < count; ++k)
            bits |= std::to_integer<uint32_t>(bytes[i + k]) << (16 - 8 * k);
        for (size_t k = 0; k < 4; ++k)
            uri += k <= count ? kDigits[(bits >> (18 - 6 * k)) & 63] : '=';
    }
    return uri;
}

std::string significant(double number, int digits) {
    return printed(number, "%.*g", digits);
}

std::string fixed_point(double number, int decimals) {
    return printed(number, "%.*f", decimals);
}

std::string percent_text(double fraction) {
    return fixed_point(100.0 * fraction, 2) + " %";
}

std::string element(std::string_view name_and_attributes, std::string_view content) {
    const std::string_view name = name_and_attributes.substr(0, name_and_attributes.find(' '));
    return str_cat("<", name_and_attributes, ">", content, "</", name, ">\n");
}

HtmlTable::HtmlTable(std::string_view caption, std::span<const std::string> headings) {
    std::string row;
    for (const std::string& heading : headings)
        row += element("th scope=\"col\"", escape_html(heading));
    text_ = element("caption", escape_html(caption)) + element("thead", element("tr", row)) +
            "<tbody>\n";
}

void HtmlTable::add_row(std::span<const std::string> cells) {
    std::string row;
    for (const std::string& cell : cells) {
        row += element(row.empty() ? "th scope=\"row\"" : "td", escape_html(cell));
    }
    text_ += element("tr", row);
}

std::string HtmlTable::html() const {
    return element("div class=\"wide\"", element("table", text_ + "</tbody>\n"));
}

}  // namespace tetralight
