// SPDX-License-Identifier: Apache-2.0
// docs/decisions/README.md lists every decision and every number without one.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <string>

#include "tests/repository/source_files.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

/// The index: number → file, empty for a number that is not used.
std::map<int, std::string> read_index() {
    const std::string text = read_text("docs/decisions/README.md");
    const std::regex row("\\n\\| ([0-9]+) \\| (?:\\[[^\\]]*\\]\\(([^)]*)\\))?");
    std::map<int, std::string> index;
    for (std::sregex_iterator it(text.begin(), text.end(), row), end; it != end; ++it) {
        EXPECT_TRUE(index.try_emplace(std::stoi((*it)[1]), (*it)[2]).second) << (*it)[1];
    }
    return index;
}

TEST(Decisions, TheIndexListsEachFile) {
    const auto index = read_index();
    for (const auto& entry :
         fs::directory_iterator(fs::path(TETRALIGHT_SOURCE_DIR) / "docs/decisions")) {
        const std::string name = entry.path().filename().string();
        if (name == "README.md") continue;
        const int number = std::stoi(name.substr(0, 4));
        ASSERT_TRUE(index.contains(number)) << name << " is not in docs/decisions/README.md";
        EXPECT_EQ(index.at(number), name);
    }
}

TEST(Decisions, NumbersHaveNoGaps) {
    int next = 1;
    for (const auto& [number, file] : read_index()) {
        EXPECT_EQ(number, next++) << "docs/decisions/README.md says nothing of a number";
    }
}

TEST(Decisions, TheirFirstLineRepeatsTheirNumber) {
    for (const auto& [number, file] : read_index()) {
        if (file.empty()) continue;
        const std::string title = "# " + std::to_string(number) + ". ";
        EXPECT_TRUE(read_text(fs::path("docs/decisions") / file).starts_with(title)) << file;
    }
}

}  // namespace
}  // namespace tetralight
