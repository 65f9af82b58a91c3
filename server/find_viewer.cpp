// SPDX-License-Identifier: Apache-2.0
#include "server/find_viewer.h"

#include <filesystem>

namespace tetralight::server {

std::string find_viewer(const std::string& program) {
    namespace fs = std::filesystem;
    const fs::path above = fs::path(program).parent_path().parent_path();
    for (const fs::path& folder : {above / "viewer", above / "share/tetralight/viewer"}) {
        std::error_code error;
        if (fs::is_regular_file(folder / "index.html", error)) return folder.string();
    }
    return "";
}

}  // namespace tetralight::server
