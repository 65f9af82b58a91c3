// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight {

/// Returns corrupt unless the metadata of a volume is one JSON object that is not nested deeper
/// than `kDeepestJson` (base/json/json_text.h), or empty. `open_probe_file` checks only that it is
/// text.
[[nodiscard]] Status check_metadata(std::string_view metadata);

}  // namespace tetralight
