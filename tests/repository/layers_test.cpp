// SPDX-License-Identifier: Apache-2.0
// The folder table of docs/architecture.md as a test.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace tetralight {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = TETRALIGHT_SOURCE_DIR;

using Folders = std::set<std::string>;

/// What each folder may include beside itself.
const std::map<std::string, Folders> kMayInclude = [] {
    std::map<std::string, Folders> table{
        {"base", {}},
        {"probes", {"base"}},
        {"probes/build/tetgen", {}},
        {"probes/build", {"base", "probes", "probes/build/tetgen"}},
        {"lppv", {"base", "probes"}},
        {"lppv/vdb", {"base", "probes", "lppv"}},
        {"runtime", {"base", "probes", "lppv"}},
        {"bake/image", {"base"}},
        {"bake/scene", {"base", "probes", "bake/image"}},
        {"bake", {"base", "probes", "bake/scene", "bake/image"}},
        {"bake/placement", {"base", "probes", "probes/build", "bake", "bake/scene", "bake/image"}},
        {"examples", {"base", "probes", "lppv", "runtime"}},
    };
    Folders all{"base",    "probes",     "probes/build", "lppv", "lppv/vdb",
                "runtime", "bake/image", "bake/scene",   "bake", "bake/placement"};
    table["pipeline"] = all;
    all.insert("pipeline");
    table["runtime/gl"] = all;
    table["server"] = {"base", "probes"};
    all.insert("server");
    all.insert("runtime/gl");
    table["cli"] = all;
    table["bench"] = all;
    return table;
}();

/// The folder of the table that a path from the root lies in; empty for none.
std::string folder_of(const fs::path& path) {
    for (fs::path folder = path.parent_path(); !folder.empty(); folder = folder.parent_path()) {
        if (kMayInclude.contains(folder.generic_string())) return folder.generic_string();
    }
    return {};
}

/// Calls `visit(file, included)` for each #include "..." of our own folders.
template <class Visit>
void for_each_include(Visit visit) {
    const std::regex include("^\\s*#include \"([^\"]+)\"");
    for (const auto& [folder, allowed] : kMayInclude) {
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
            const fs::path file = fs::relative(entry.path(), kRoot);
            const bool is_source = file.extension() == ".h" || file.extension() == ".cpp";
            if (!is_source || folder_of(file) != folder) continue;
            std::ifstream stream(entry.path());
            std::smatch match;
            for (std::string line; std::getline(stream, line);) {
                if (std::regex_search(line, match, include)) visit(file, fs::path(match[1].str()));
            }
        }
    }
}

TEST(Layers, FoldersIncludeOnlyWhatTheTableNames) {
    size_t count = 0;
    for_each_include([&](const fs::path& file, const fs::path& included) {
        ++count;
        const std::string from = folder_of(file);
        const std::string to = folder_of(included);
        EXPECT_TRUE(to == from || kMayInclude.at(from).contains(to))
            << file << " must not include " << included;
    });
    EXPECT_GT(count, 100u);
}

TEST(Layers, DetailHeadersStayInTheirFolder) {
    for_each_include([&](const fs::path& file, const fs::path& included) {
        if (included.parent_path().filename() != "detail") return;
        EXPECT_EQ(folder_of(file), folder_of(included)) << file << " includes " << included;
    });
}

TEST(Layers, TheTableHasNoCycle) {
    for (const auto& [folder, allowed] : kMayInclude) {
        for (const std::string& lower : allowed) {
            EXPECT_FALSE(kMayInclude.at(lower).contains(folder)) << folder << " and " << lower;
        }
    }
}

TEST(Layers, EverySourceSaysItsLicenceFirst) {
    for (const char* top : {"base", "probes", "lppv", "runtime", "bake", "pipeline", "server",
                            "cli", "bench", "examples", "tests"}) {
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
            const fs::path extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp") continue;
            std::ifstream stream(entry.path());
            std::string line;
            std::getline(stream, line);
            EXPECT_EQ(line, "// SPDX-License-Identifier: Apache-2.0") << entry.path();
        }
    }
}

}  // namespace
}  // namespace tetralight
