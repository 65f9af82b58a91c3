// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/json_text.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>

namespace tetralight {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_hex_digit(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

/// Steps over JSON. Each function takes what its name says, or says that it is not there.
/// Precondition: the text is not nested too deep.
class JsonScanner {
  public:
    explicit JsonScanner(std::string_view text) : text_(text) {}

    bool take_document() {
        skip_space();
        if (!take_object()) return false;
        skip_space();
        return place_ == text_.size();
    }

    [[nodiscard]] size_t place() const { return place_; }

  private:
    [[nodiscard]] char next() const { return place_ < text_.size() ? text_[place_] : '\0'; }

    bool take(char c) {
        if (next() != c) return false;
        ++place_;
        return true;
    }

    void skip_space() {
        place_ = std::min(text_.find_first_not_of(" \t\n\r", place_), text_.size());
    }

    bool take_word(std::string_view word) {
        if (text_.substr(place_, word.size()) != word) return false;
        place_ += word.size();
        return true;
    }

    bool take_value() {
        skip_space();
        const bool is_taken = next() == '{'   ? take_object()
                              : next() == '[' ? take_array()
                              : next() == '"' ? take_string()
                                              : take_literal();
        skip_space();
        return is_taken;
    }

    bool take_literal() {
        return take_word("true") || take_word("false") || take_word("null") || take_number();
    }

    bool take_object() {
        if (!take('{')) return false;
        skip_space();
        if (take('}')) return true;
        do {
            skip_space();
            if (!take_string()) return false;
            skip_space();
            if (!take(':') || !take_value()) return false;
        } while (take(','));
        return take('}');
    }

    bool take_array() {
        ++place_;
        skip_space();
        if (take(']')) return true;
        do {
            if (!take_value()) return false;
        } while (take(','));
        return take(']');
    }

    bool take_string() {
        if (!take('"')) return false;
        while (place_ < text_.size() && next() != '"') {
            if (static_cast<unsigned char>(next()) < ' ') return false;
            if (next() != '\\') {
                ++place_;
            } else if (!take_escape()) {
                return false;
            }
        }
        return take('"');
    }

    bool take_escape() {
        ++place_;
        if (!take('u')) {
            const bool is_known = next() != '\0' && std::string_view("\"\\/bfnrt").find(next()) !=
                                                        std::string_view::npos;
            ++place_;
            return is_known;
        }
        for (int i = 0; i < 4; ++i) {
            if (!is_hex_digit(next())) return false;
            ++place_;
        }
        return true;
    }

    bool take_digits() {
        const size_t begin = place_;
        while (is_digit(next())) ++place_;
        return place_ > begin;
    }

    bool take_number() {
        take('-');
        if (!take('0') && !take_digits()) return false;
        if (take('.') && !take_digits()) return false;
        if (!take('e') && !take('E')) return true;
        if (!take('+')) take('-');
        return take_digits();
    }

    std::string_view text_;
    size_t place_ = 0;
};

}  // namespace

Status check_json_depth(std::string_view json) {
    int depth = 0;
    bool is_in_string = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (is_in_string) {
            i += c == '\\';  // whatever is escaped does not end the string
            is_in_string = c != '"';
        } else if (c == '"') {
            is_in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > kDeepestJson) {
                return Error{str_cat("JSON is nested deeper than ", kDeepestJson)};
            }
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return Ok{};
}

Status check_json_object(std::string_view json) {
    if (auto status = check_json_depth(json); !status) return status;
    JsonScanner scanner(json);
    if (!scanner.take_document()) {
        return Error{str_cat("is not a JSON object (byte ", scanner.place(), ")")};
    }
    return is_utf8(json) ? Status(Ok{}) : Error{"is not UTF-8"};
}

std::string json_error_reason(const std::exception& exception) {
    const std::string message = exception.what();
    const size_t end = message.starts_with('[') ? message.find("] ") : std::string::npos;
    return end == std::string::npos ? message : message.substr(end + 2);
}

}  // namespace tetralight
