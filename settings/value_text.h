// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/base/result.h>
#include <tetralight/settings/values.h>

namespace tetralight::settings {

/// The value of a setting, or of one element of a list, from the text of its option. Errors say
/// what is wrong without the name of the setting.
[[nodiscard]] Result<Json> value_from_text(const Setting& setting, std::string_view text);

}  // namespace tetralight::settings
