// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight::detail {

[[nodiscard]] bool is_data_uri(std::string_view uri);

/// Path below the glTF file's folder that a relative URI names, percent-decoded. Returns
/// unsupported for absolute paths, `..` and schemes such as `file:`, so that a scene cannot read
/// files outside of its folder.
[[nodiscard]] Result<std::string> relative_path_from_uri(std::string_view uri);

/// Folder of a file, to be joined with a name: "" or ends in '/'.
[[nodiscard]] std::string folder_of(const std::string& path);

}  // namespace tetralight::detail
