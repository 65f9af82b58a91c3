// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>
#include <tetralight/settings/values.h>

namespace tetralight {

/// Limits as numbers by their names, of an object with the settings of `settings::kLimits`, in
/// which "1%" and "2h" are allowed. Returns invalid_argument about one member.
[[nodiscard]] Result<settings::Json> read_limits(const settings::Json& json);

/// True if a limit is one of results of a kind: "probes", "lightmaps" or "reflections".
[[nodiscard]] bool is_limited(const std::string& limit, const std::string& kind);

}  // namespace tetralight
