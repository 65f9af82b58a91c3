// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/backend_program.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include <tetralight/base/str_cat.h>

namespace tetralight::cli {

std::string backend_variable(std::string_view backend) {
    return backend == "cgal" ? "TETRALIGHT_CGAL" : "TETRALIGHT_TETGEN";
}

TetrahedraProgram find_backend_program(std::string_view backend) {
    const char* named = std::getenv(backend_variable(backend).c_str());
    if (named != nullptr && *named != '\0') return {named};
    const std::string name = str_cat("tetralight-", backend);
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::string beside = (self.parent_path() / name).string();
    return {!error && ::access(beside.c_str(), X_OK) == 0 ? beside : name};
}

}  // namespace tetralight::cli
