// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>
#include <tetralight/settings/values.h>

namespace tetralight::settings {

/// The value of a setting, or of one element of a list, from JSON: the same value as from the text
/// of its option (`value_from_text`). Errors say what is wrong without the name of the setting.
[[nodiscard]] Result<Json> value_from_json(const Setting& setting, const Json& json);

/// A value in a message: texts without quotes, all else as JSON; shortened if it is long.
[[nodiscard]] std::string shown_value(const Json& value);

}  // namespace tetralight::settings
