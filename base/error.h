// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace tetralight {

/// What kind of failure an error is. Programs branch on this, never on the message.
enum class ErrorCode : uint8_t {
    InvalidArgument,  ///< a setting or an argument is out of range, or does not fit the data
    Corrupt,          ///< the bytes of a file are wrong: reading it again gives the same error
    Unsupported,      ///< valid data that this version or this build does not handle
    NotFound,         ///< there is no such file, node, group, layer...
    Unavailable,      ///< a file is out of reach for now (EIO, ESTALE, EACCES): try again
    OutOfResources,   ///< memory, descriptors or processes are used up for now: try again
    DiskFull,         ///< no space left where a file is written: try again with more
    Cancelled,        ///< the caller or a signal stopped the work
};

/// The code as JSON and logs write it: "invalid_argument", "corrupt"...
[[nodiscard]] std::string_view error_code_name(ErrorCode code) noexcept;

/// True if the same call may succeed later without any change to its arguments or files:
/// Unavailable, OutOfResources and DiskFull.
[[nodiscard]] bool can_retry(ErrorCode code) noexcept;

/// One line of text for a person. It can be extended and printed (base/error_text.h), but neither
/// compared nor searched, so that no program depends on its words.
class Message {
  public:
    Message() = default;

    Message(std::string text) : text_(std::move(text)) {}

    Message(const char* text) : text_(text) {}

    [[nodiscard]] Message prefixed(std::string_view words) const {
        return std::string(words) + text_;
    }

    [[nodiscard]] Message suffixed(std::string_view words) const {
        return text_ + std::string(words);
    }

  private:
    friend const std::string& error_text(const Message& message) noexcept;

    std::string text_;
};

/// Why data could not be used. The message says what, where and the value, in one line.
/// Example: `groups.json: group "hall": probe 7: position is not finite (nan, 0, 1)`.
struct Error {
    ErrorCode code = ErrorCode::InvalidArgument;
    /// The setting, option or member of a file that is wrong: "samples", "probes[7].position".
    /// Empty if the error is about no single one.
    std::string field;
    /// Its value as text, as the caller or the file gave it; may be shortened. Empty if unknown.
    std::string value;
    Message message;

    Error() = default;

    Error(ErrorCode error_code, Message error_message)
        : code(error_code), message(std::move(error_message)) {}

    Error(ErrorCode error_code, std::string field_name, std::string field_value,
          Message error_message)
        : code(error_code),
          field(std::move(field_name)),
          value(std::move(field_value)),
          message(std::move(error_message)) {}

    /// The same error with a place before the message: `b` in `a` reads `a: b`.
    [[nodiscard]] Error in(std::string_view place) const {
        Error error = *this;
        error.message = message.prefixed(std::string(place) + ": ");
        return error;
    }
};

}  // namespace tetralight
