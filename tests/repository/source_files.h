// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tetralight {

/// The text of a file; its path is relative to the repository.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

/// The C++ headers and sources below a folder, relative to the repository and sorted. Build
/// directories and installed packages are left out.
[[nodiscard]] std::vector<std::filesystem::path> source_files(const std::filesystem::path& folder);

/// The CMakeLists.txt files below a folder, relative to the repository and sorted.
[[nodiscard]] std::vector<std::filesystem::path> build_files(const std::filesystem::path& folder);

/// Every folder of the repository that holds C++.
[[nodiscard]] std::vector<std::string> source_folders();

/// The same text with comments, string literals and character literals replaced by spaces. Lines
/// keep their numbers.
[[nodiscard]] std::string without_comments_and_strings(const std::string& text);

}  // namespace tetralight
