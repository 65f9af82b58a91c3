// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/repository/source_files.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

/// The text of all CMakeLists.txt files.
std::string all_build_files() {
    std::string text;
    for (const std::string& folder : source_folders()) {
        for (const fs::path& file : build_files(folder)) text += read_text(file);
    }
    return text;
}

/// True if the build file of a folder above the source names it by its path from that folder.
bool is_named_above(const fs::path& source) {
    for (fs::path folder = source.parent_path(); !folder.empty(); folder = folder.parent_path()) {
        const std::string name = source.lexically_relative(folder).generic_string();
        if (read_text(folder / "CMakeLists.txt").find(name) != std::string::npos) return true;
    }
    return false;
}

TEST(Sources, ABuildFileNamesEachOfThem) {
    const std::string everything = all_build_files();
    size_t count = 0;
    for (const std::string& folder : source_folders()) {
        for (const fs::path& source : source_files(folder)) {
            if (source.extension() != ".cpp") continue;
            ++count;
            EXPECT_TRUE(is_named_above(source) ||
                        everything.find(source.generic_string()) != std::string::npos)
                << source << " is not compiled";
        }
    }
    EXPECT_GT(count, 500u);
}

}  // namespace
}  // namespace tetralight
