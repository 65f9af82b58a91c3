// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/find_viewer.h>

#include <filesystem>

namespace tetralight::server {

bool has_page(std::string_view folder) {
    std::error_code error;
    return std::filesystem::is_regular_file(std::filesystem::path(folder) / "index.html", error);
}

std::string find_viewer(const std::string& program) {
    namespace fs = std::filesystem;
    const fs::path above = fs::path(program).parent_path().parent_path();
    for (const fs::path& folder : {above / "viewer", above / "share/tetralight/viewer"}) {
        if (has_page(folder.string())) return folder.string();
    }
    return "";
}

}  // namespace tetralight::server
