// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tetralight::server {

/// True if a folder has a page to serve.
[[nodiscard]] bool has_page(std::string_view folder);

/// The folder of the viewer's page that belongs to a program: `../viewer` of the program's folder
/// in a build tree, `../share/tetralight/viewer` where it is installed. Empty if neither exists.
[[nodiscard]] std::string find_viewer(const std::string& program);

}  // namespace tetralight::server
