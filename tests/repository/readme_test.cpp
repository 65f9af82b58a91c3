// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

namespace tetralight {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = TETRALIGHT_SOURCE_DIR;

std::string contents(const fs::path& path) {
    std::ifstream stream(kRoot / path);
    return (std::ostringstream() << stream.rdbuf()).str();
}

TEST(Readme, ShowsTheExampleThatIsCompiled) {
    const std::string readme = contents("README.md");
    const std::string fence = "```cpp\n";
    const size_t begin = readme.find(fence) + fence.size();
    const std::string snippet = readme.substr(begin, readme.find("```", begin) - begin);
    ASSERT_GT(snippet.size(), 100u);
    EXPECT_NE(contents("examples/minimal/minimal.cpp").find(snippet), std::string::npos);
}

TEST(Readme, LinksAndPicturesExist) {
    const std::regex link("\\]\\(([^)#:]+)\\)");
    std::vector<fs::path> pages{kRoot / "README.md"};
    for (const auto& entry : fs::directory_iterator(kRoot / "docs")) {
        if (entry.path().extension() == ".md") pages.push_back(entry.path());
    }
    for (const fs::path& page : pages) {
        const std::string text = contents(page.string());
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
