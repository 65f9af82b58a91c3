// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/detail/unity_documents.h>

#include <algorithm>
#include <charconv>
#include <string>

#include <tetralight/base/str_cat.h>
#include <tetralight/imports/detail/text_file.h>

namespace tetralight::detail {
namespace {

constexpr std::string_view kMark = "---";

Error header_error(size_t line, std::string_view header, std::string_view reason) {
    return {ErrorCode::Corrupt, "", std::string(header.substr(0, 60)),
            str_cat(line, ": the header of an object ", reason, " (", quoted_text(header), ")")};
}

/// Takes `prefix` and an integer from the beginning of a text; none if it has another beginning.
std::optional<int64_t> take_integer(std::string_view& text, std::string_view prefix) {
    if (!text.starts_with(prefix)) return std::nullopt;
    int64_t number = 0;
    const char* const first = text.data() + prefix.size();
    const auto [end, error] = std::from_chars(first, text.data() + text.size(), number);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<size_t>(end - text.data()));
    return number;
}

Result<UnityDocument> parse_header(std::string_view header, size_t line) {
    UnityDocument document{.line = line};
    std::string_view rest = header;
    const auto class_id = take_integer(rest, "--- !u!");
    if (!class_id) return header_error(line, header, "does not begin with --- !u!CLASS");
    const auto id = take_integer(rest, " &");
    if (!id) return header_error(line, header, "does not have &ID, an integer of 64 bits");
    document.class_id = *class_id;
    document.id = *id;
    document.is_stripped = rest == " stripped";
    if (!rest.empty() && !document.is_stripped)
        return header_error(line, header, "does not end after &ID");
    return document;
}

}  // namespace

std::string_view UnityDocuments::take_line() {
    std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(rest_.size(), line.size() + 1));
    ++line_;
    while (line.ends_with('\r') || line.ends_with(' ')) line.remove_suffix(1);
    return line;
}

Status UnityDocuments::skip_directives() {
    if (!rest_.starts_with("%YAML")) {
        return Error{ErrorCode::Corrupt,
                     "1: is not a text file of Unity, which begins with %YAML; set Edit > Project "
                     "Settings > Editor > Asset Serialization > Mode to Force Text"};
    }
    while (!rest_.empty() && !rest_.starts_with(kMark)) take_line();
    return Ok{};
}

Result<std::optional<UnityDocument>> UnityDocuments::next() {
    if (is_at_start_) {
        is_at_start_ = false;
        if (auto status = skip_directives(); !status) return status.error();
    }
    if (rest_.empty()) return std::optional<UnityDocument>();
    const size_t line = line_;
    auto document = parse_header(take_line(), line);
    if (!document) return document.error();
    // The next header stands at the beginning of a line, where YAML allows nothing else.
    size_t length = 0;
    if (!rest_.starts_with(kMark)) {
        const size_t end = rest_.find("\n---");
        length = end == std::string_view::npos ? rest_.size() : end + 1;
    }
    document->body = rest_.substr(0, length);
    line_ += static_cast<size_t>(std::ranges::count(document->body, '\n'));
    rest_.remove_prefix(length);
    return std::optional(*document);
}

}  // namespace tetralight::detail
