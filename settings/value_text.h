// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <tetralight/base/result.h>
#include <tetralight/settings/values.h>

// One value of a setting: from the text of an option, or from JSON. Both give the same value. The
// messages of errors say what is wrong with the value, without the name of the setting.

namespace tetralight::settings {

/// Of a list: one element.
[[nodiscard]] Result<Json> value_from_text(const Setting& setting, std::string_view text);

/// Of a list: one element.
[[nodiscard]] Result<Json> value_from_json(const Setting& setting, const Json& json);

/// A value in a message: texts without quotes, all else as JSON; shortened if it is long.
[[nodiscard]] std::string shown_value(const Json& value);

}  // namespace tetralight::settings
