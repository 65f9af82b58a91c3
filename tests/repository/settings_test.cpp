// SPDX-License-Identifier: Apache-2.0
// Settings are described once, in the tables of settings/.
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

const fs::path kRoot = TETRALIGHT_SOURCE_DIR;

/// A file that names this many settings is a list of them. Fewer are single uses: a value that is
/// read, the field of an error.
constexpr size_t kListLength = 6;

/// Which member each setting of a bake sets: for the command, which reads the settings, and for
/// the metadata of volumes and lightmaps, which records them.
const std::set<std::string> kMemberLists{"pipeline/bake_members.h", "pipeline/lightmap_settings.h"};

std::set<std::string> names_matching(const std::string& text, const std::string& pattern) {
    const std::regex name(pattern);
    std::set<std::string> names;
    for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it) {
        names.insert((*it)[1]);
    }
    return names;
}

/// The settings in the tables whose names have several words: single words have other meanings.
std::set<std::string> setting_names() {
    std::set<std::string> names;
    for (const fs::path& file : source_files("settings")) {
        names.merge(names_matching(read_text(file), "\\.name = \"([a-z]+_[a-z_]+)\""));
    }
    return names;
}

/// C++ and TypeScript files outside of settings/ and cli/, which reads the values.
std::vector<fs::path> other_sources() {
    std::vector<fs::path> files;
    for (const char* folder : {"bake", "pipeline", "probes", "lppv", "render", "server"}) {
        for (const fs::path& file : source_files(folder)) files.push_back(file);
    }
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / "viewer/src")) {
        if (entry.path().extension() == ".ts") files.push_back(fs::relative(entry.path(), kRoot));
    }
    return files;
}

TEST(Settings, NoOtherFileListsTheirNames) {
    const std::set<std::string> settings = setting_names();
    ASSERT_GT(settings.size(), 20u);
    for (const fs::path& file : other_sources()) {
        if (kMemberLists.contains(file.generic_string())) continue;
        size_t count = 0;
        for (const std::string& name : names_matching(read_text(file), "[\"']([a-z_]+)[\"']")) {
            count += settings.count(name);
        }
        EXPECT_LT(count, kListLength) << file << " lists the names of settings";
    }
}

}  // namespace
}  // namespace tetralight
