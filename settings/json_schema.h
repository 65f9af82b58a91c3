// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/settings/values.h>

namespace tetralight::settings {

/// One setting as a JSON Schema, as openapi.json has it: type, description, limits, default, and
/// "x-unit".
[[nodiscard]] Json json_schema(const Setting& setting);

/// An object with the settings of a command that `caller` may set, with its required members.
[[nodiscard]] Json json_schema(const Table& table, Access caller);

}  // namespace tetralight::settings
