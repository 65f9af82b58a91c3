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

/// Path of the file that a relative URI of a scene names. Returns the errors of
/// relative_path_from_uri(), and unsupported for symbolic links to files outside of the scene's
/// folder and of the folder of the file to which the scene itself is a link.
[[nodiscard]] Result<std::string> path_from_uri(std::string_view uri,
                                                const std::string& scene_path);

}  // namespace tetralight::detail
