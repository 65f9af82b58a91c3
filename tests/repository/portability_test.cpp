// SPDX-License-Identifier: Apache-2.0
// What docs/portability.md promises of the sources of the ship set.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/repository/source_files.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

/// The folders of the ship set, from the sentence in docs/architecture.md that lists them.
std::set<fs::path> ship_folders() {
    const std::string page = read_text("docs/architecture.md");
    std::smatch list;
    std::regex_search(page, list, std::regex("The ship set is ([^:]*):"));
    const std::string text = list[1];
    const std::regex folder("`([a-z/]+)`");
    std::set<fs::path> folders;
    for (std::sregex_iterator it(text.begin(), text.end(), folder), end; it != end; ++it) {
        folders.insert((*it)[1].str());
        folders.insert((*it)[1].str() + "/detail");
    }
    return folders;
}

std::vector<fs::path> ship_files() {
    std::vector<fs::path> files;
    for (const fs::path& folder : ship_folders()) {
        if (folder.filename() == "detail") continue;
        for (const fs::path& file : source_files(folder)) {
            const fs::path parent = file.parent_path();
            if (parent == folder || parent == folder / "detail") files.push_back(file);
        }
    }
    return files;
}

/// True for the sources that may use an operating system.
bool is_of_one_system(const fs::path& file) {
    return file == "base/detail/file_system_posix.cpp" ||
           file == "base/detail/file_system_windows.cpp";
}

/// True for headers of the C++ standard that need no files, our own ones, and those of libraries.
bool is_portable(const std::string& header) {
    static const std::set<std::string> kNamed = {"xxhash.h", "stdbool.h", "stddef.h", "stdint.h"};
    static const std::set<std::string> kOfFiles = {"filesystem", "fstream", "iostream"};
    for (const char* library : {"tetralight/", "glm/", "hwy/"}) {
        if (header.starts_with(library)) return true;
    }
    return kNamed.contains(header) ||
           (header.find_first_of("./") == std::string::npos && !kOfFiles.contains(header));
}

TEST(Portability, TheShipSetIsListed) {
    EXPECT_EQ(ship_folders().size(), 16u);
    EXPECT_GT(ship_files().size(), 200u);
}

TEST(Portability, OneSourceOfTheShipSetUsesASystem) {
    const std::regex include("#[ \\t]*include[ \\t]*<([^>]+)>");
    for (const fs::path& file : ship_files()) {
        if (is_of_one_system(file)) continue;
        const std::string text = read_text(file);
        for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
            EXPECT_TRUE(is_portable((*it)[1])) << file << " includes " << (*it)[1];
        }
    }
}

TEST(Portability, SourcesDoNotAskForTheSystem) {
    const std::regex macro(
        "\\b(_WIN32|_WIN64|__linux__|__unix__|__APPLE__|__wasm__|_POSIX_\\w+)\\b");
    for (const fs::path& file : ship_files()) {
        if (file == "runtime/tetralight.h") continue;  // says how shared libraries export symbols
        const std::string text = without_comments_and_strings(read_text(file));
        EXPECT_FALSE(std::regex_search(text, macro)) << file;
    }
}

TEST(Portability, ThePageListsEachPlatform) {
    const std::string script = read_text("tests/portability/portability.py");
    const std::string page = read_text("docs/portability.md");
    const std::regex row("\n    Platform\\(\"([a-z0-9]+)\"");
    size_t count = 0;
    for (std::sregex_iterator it(script.begin(), script.end(), row), end; it != end; ++it) {
        ++count;
        EXPECT_NE(page.find("\n| `" + (*it)[1].str() + "` |"), std::string::npos) << (*it)[1];
    }
    EXPECT_GE(count, 3u);
}

}  // namespace
}  // namespace tetralight
