// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tetralight::fuzz {

/// The bytes of a file; fails the test if it cannot be read.
[[nodiscard]] std::string read_text(const std::string& path);

/// The bytes of the files of a folder, in the order of their names.
[[nodiscard]] std::vector<std::string> seed_files(const std::string& folder);

}  // namespace tetralight::fuzz
