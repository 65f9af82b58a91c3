// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/tetgen_program.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace tetralight::cli {

TetgenProgram find_tetgen_program() {
    TetgenProgram program;
    const char* named = std::getenv(kTetgenVariable);
    if (named != nullptr && *named != '\0') {
        program.path = named;
        return program;
    }
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::string beside = (self.parent_path() / program.path).string();
    if (!error && ::access(beside.c_str(), X_OK) == 0) program.path = beside;
    return program;
}

}  // namespace tetralight::cli
