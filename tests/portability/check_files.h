// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tetralight::portability {

/// Writes, replaces and reads files in a folder. Returns what is wrong; nothing if all is right.
[[nodiscard]] std::vector<std::string> check_files(const std::string& folder);

}  // namespace tetralight::portability
