// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/detail/record_relit.h>

#include <algorithm>
#include <optional>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// Reads the names of an object's members and skips their values: brackets and strings are all that
/// it knows of JSON.
class MemberScanner {
  public:
    explicit MemberScanner(std::string_view text) : text_(text) {}

    /// Skips spaces, then the expected character. Returns false if another character follows.
    bool take(char expected) {
        skip_spaces();
        if (place_ >= text_.size() || text_[place_] != expected) return false;
        ++place_;
        return true;
    }

    /// Skips a string and returns it with its quotes, or an empty text if no string follows.
    std::string_view take_string() {
        skip_spaces();
        const size_t begin = place_;
        if (!take('"')) return {};
        while (place_ < text_.size() && text_[place_] != '"')
            place_ += text_[place_] == '\\' ? 2 : 1;
        if (!take('"')) return {};
        return text_.substr(begin, place_ - begin);
    }

    /// Skips a value up to the comma or bracket after it, and returns the value, or an empty text
    /// if neither follows.
    std::string_view take_value() {
        skip_spaces();
        const size_t begin = place_;
        int depth = 0;
        while (place_ < text_.size()) {
            const char c = text_[place_];
            if (depth == 0 && (c == ',' || c == '}')) return text_.substr(begin, place_ - begin);
            if (c == '{' || c == '[') ++depth;
            if (c == '}' || c == ']') --depth;
            if (c != '"') {
                ++place_;
            } else if (take_string().empty()) {
                break;
            }
        }
        return {};
    }

    [[nodiscard]] size_t place() const { return place_; }

    bool is_at_end() {
        skip_spaces();
        return place_ == text_.size();
    }

  private:
    void skip_spaces() {
        place_ = std::min(text_.find_first_not_of(" \t\r\n", place_), text_.size());
    }

    std::string_view text_;
    size_t place_ = 0;
};

struct ObjectText {
    size_t end = 0;  ///< the place of its last bracket
    bool is_empty = true;
    std::string_view relit;  ///< the value of this member, perhaps with spaces after it
};

/// Nothing if the text is not an object.
std::optional<ObjectText> scan_object(std::string_view text) {
    MemberScanner scanner(text);
    if (!scanner.take('{')) return std::nullopt;
    ObjectText object;
    while (!scanner.take('}')) {
        if (!object.is_empty && !scanner.take(',')) return std::nullopt;
        const std::string_view name = scanner.take_string();
        if (name.empty() || !scanner.take(':')) return std::nullopt;
        const std::string_view value = scanner.take_value();
        if (value.empty()) return std::nullopt;
        if (name == "\"relit\"") object.relit = value;
        object.is_empty = false;
    }
    object.end = scanner.place() - 1;
    if (!scanner.is_at_end()) return std::nullopt;
    return object;
}

/// The text of a JSON string without its quotes; empty if the value is of another type.
std::string_view inside_quotes(std::string_view value) {
    if (!value.starts_with('"')) return {};
    return value.substr(1, value.rfind('"') - 1);
}

bool has_word(std::string_view text, std::string_view word) {
    return str_cat(' ', text, ' ').find(str_cat(' ', word, ' ')) != std::string::npos;
}

}  // namespace

std::string record_relit(std::string_view metadata, std::string_view call) {
    const auto object = scan_object(metadata);
    if (!object) return str_cat("{\"relit\":\"", call, "\"}");
    if (object->relit.empty()) {
        return str_cat(metadata.substr(0, object->end), object->is_empty ? "" : ",", "\"relit\":\"",
                       call, "\"", metadata.substr(object->end));
    }
    const std::string_view earlier = inside_quotes(object->relit);
    if (has_word(earlier, call)) return std::string(metadata);
    const auto begin = static_cast<size_t>(object->relit.data() - metadata.data());
    return str_cat(metadata.substr(0, begin), '"', earlier, earlier.empty() ? "" : " ", call, '"',
                   metadata.substr(begin + object->relit.size()));
}

}  // namespace tetralight::detail
