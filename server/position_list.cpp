// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/position_list.h>

#include <charconv>

namespace tetralight::server {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Where a text is read. Functions return false if something else follows.
class Cursor {
  public:
    explicit Cursor(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

    [[nodiscard]] const char* at() const { return at_; }

    /// Blanks, then this character.
    bool take(char c) {
        while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) ++at_;
        return take_next(c);
    }

    /// A string without escapes.
    bool take_string(std::string_view& characters) {
        if (!take('"')) return false;
        const char* const begin = at_;
        while (at_ != end_ && *at_ != '"' && *at_ != '\\') ++at_;
        characters = {begin, static_cast<size_t>(at_ - begin)};
        return take_next('"');
    }

    /// A value that holds no others: a string, or anything up to the next member.
    bool skip_value() {
        std::string_view ignored;
        if (take_string(ignored)) return true;
        while (at_ != end_ && (is_digit(*at_) || (*at_ >= 'a' && *at_ <= 'z') || *at_ == '-' ||
                               *at_ == '+' || *at_ == '.' || *at_ == 'E')) {
            ++at_;
        }
        return true;
    }

    bool take_position(glm::vec3& position) {
        return take('[') && take_float(position.x) && take(',') && take_float(position.y) &&
               take(',') && take_float(position.z) && take(']');
    }

  private:
    bool take_next(char c) {
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }

    bool take_digits() {
        const char* const begin = at_;
        while (at_ != end_ && is_digit(*at_)) ++at_;
        return at_ != begin;
    }

    /// A number as JSON has it (RFC 8259, section 6).
    bool take_float(float& number) {
        const bool is_negative = take('-');
        const char* const begin = is_negative ? at_ - 1 : at_;
        if (!take_next('0') && !take_digits()) return false;
        if (take_next('.') && !take_digits()) return false;
        if (take_next('e') || take_next('E')) {
            if (!take_next('+')) take_next('-');
            if (!take_digits()) return false;
        }
        const auto [end, error] = std::from_chars(begin, at_, number);
        return error == std::errc{} && end == at_;
    }

    const char* at_;
    const char* end_;
};

/// Stands behind the colon of the member afterwards.
bool find_member(Cursor& cursor, std::string_view name) {
    if (!cursor.take('{')) return false;
    for (std::string_view key; cursor.take_string(key) && cursor.take(':');) {
        if (key == name) return true;
        if (!cursor.skip_value() || !cursor.take(',')) return false;
    }
    return false;
}

}  // namespace

std::optional<std::string> take_positions(std::string_view json,
                                          std::vector<glm::vec3>& positions) {
    positions.clear();
    Cursor cursor(json);
    if (!find_member(cursor, "positions") || !cursor.take('[')) return std::nullopt;
    const char* const begin = cursor.at();
    while (!cursor.take(']')) {
        if (!positions.empty() && !cursor.take(',')) return std::nullopt;
        if (!cursor.take_position(positions.emplace_back())) return std::nullopt;
    }
    std::string rest(json.substr(0, static_cast<size_t>(begin - json.data())));
    return rest += json.substr(static_cast<size_t>(cursor.at() - 1 - json.data()));
}

}  // namespace tetralight::server
