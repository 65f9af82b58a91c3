// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/repository/source_files.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = TETRALIGHT_SOURCE_DIR;

TEST(Readme, ShowsTheWholeExample) {
    const std::string readme = read_text("README.md");
    const std::string fence = "```cpp\n";
    const size_t begin = readme.find(fence) + fence.size();
    const std::string snippet = readme.substr(begin, readme.find("```", begin) - begin);
    const std::string licence = "// SPDX-License-Identifier: Apache-2.0\n";
    EXPECT_EQ(read_text("examples/minimal/minimal.cpp"), licence + snippet);
}

TEST(Readme, LinksAndPicturesExist) {
    const std::regex link("\\]\\(([^)#:]+)\\)");
    std::vector<fs::path> pages{kRoot / "README.md", kRoot / "CONTRIBUTING.md"};
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs")) {
        if (entry.path().extension() == ".md") pages.push_back(entry.path());
    }
    for (const fs::path& page : pages) {
        const std::string text = read_text(fs::relative(page, kRoot));
        for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
            EXPECT_TRUE(fs::exists(page.parent_path() / (*it)[1].str()))
                << page << " links to " << (*it)[1];
        }
    }
}

TEST(Readme, PicturesAreSmall) {
    for (const auto& entry : fs::directory_iterator(kRoot / "docs/images")) {
        EXPECT_LE(entry.file_size(), 300'000u) << entry.path();
    }
}

}  // namespace
}  // namespace tetralight
