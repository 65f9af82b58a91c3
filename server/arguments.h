// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <tetralight/server/json.h>

namespace tetralight::server {

/// What a member of a request may be, and so what text the command gets for it.
enum class ValueKind : uint8_t {
    Number,
    Integer,
    Flag,
    Text,
    Texts,    ///< each by an option of its own
    List,     ///< of words, with commas between
    Vector,   ///< three numbers
    Numbers,  ///< any number of them, with commas between
    Scale,    ///< a number or three
};

/// A member that stands for an option of the command: "target_error" for `--target-error`.
struct OptionRule {
    const char* member;
    ValueKind kind;
};

/// The options for the members of a request that are there. Throws a `Problem` for one of another
/// kind; whether its value is in range is the command's to say.
[[nodiscard]] std::vector<std::string> make_arguments(Fields& fields,
                                                      std::span<const OptionRule> rules);

}  // namespace tetralight::server
