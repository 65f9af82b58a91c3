// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/settings/values.h>

namespace tetralight::settings {

/// An option or a positional argument as it was typed. `text` of a flag: "true".
struct Argument {
    const Setting* setting;
    std::string text;
};

/// Checks the arguments of a command line. Returns invalid_argument about one setting if a value
/// is of another form or out of range, if one is given twice, missing, or does not go with another.
[[nodiscard]] Result<Values> values_from_arguments(const Table& table,
                                                   std::span<const Argument> arguments);

/// The same for the members of a JSON object; null members count as not given. `caller`
/// Access::Service refuses settings that only the command may have, as unknown ones. Members of
/// `others`, separated by blanks, are for the caller and left alone.
[[nodiscard]] Result<Values> values_from_json(const Table& table, const Json& json, Access caller,
                                              std::string_view others = {});

}  // namespace tetralight::settings
