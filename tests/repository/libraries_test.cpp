// SPDX-License-Identifier: Apache-2.0
// What docs/architecture.md says about outside libraries: which folders use them, and which files
// include those that have versions.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "tests/repository/source_files.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

using Files = std::set<std::string>;

/// How the headers of a library begin, and the library's name in docs/architecture.md.
const std::map<std::string, std::string> kLibraries = {
    {"CGAL/", "CGAL"},
    {"CLI/", "CLI11"},
    {"EGL/", "EGL"},
    {"GL/", "OpenGL"},
    {"GLFW/", "GLFW"},
    {"openssl/", "OpenSSL"},
    {"Eigen/", "Eigen"},
    {"Imf", "OpenEXR"},
    {"boost/", "Boost"},
    {"draco/", "Draco"},
    {"embree", "Embree"},
    {"hwy/", "Highway"},
    {"jerror.h", "libjpeg-turbo"},
    {"jpeglib.h", "libjpeg-turbo"},
    {"meshoptimizer.h", "meshoptimizer"},
    {"nanovdb/", "NanoVDB"},
    {"nlohmann/", "nlohmann-json"},
    {"openvdb/", "OpenVDB"},
    {"sqlite3", "SQLite"},
    {"spng.h", "libspng"},
    {"tbb/", "TBB"},
    {"tetgen.h", "TetGen"},
    {"webp/", "libwebp"},
    {"xxhash", "xxHash"},
    {"yaml.h", "libyaml"},
};

/// The files of the product (no tests, benchmarks or examples) that include each library.
std::map<std::string, Files> find_users() {
    const std::regex include("(?:^|\\n)[ \\t]*#[ \\t]*include[ \\t]*<([^>]+)>");
    std::map<std::string, Files> users;
    for (const std::string& folder : source_folders()) {
        if (folder == "tests" || folder == "bench" || folder == "examples") continue;
        for (const fs::path& file : source_files(folder)) {
            const std::string text = read_text(file);
            for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
                for (const auto& [prefix, library] : kLibraries) {
                    if ((*it)[1].str().starts_with(prefix))
                        users[library].insert(file.generic_string());
                }
            }
        }
    }
    return users;
}

/// Rows of docs/architecture.md whose first cell is `name`: that name and the row's last cell.
std::map<std::string, std::string> last_cells(const std::string& first_cell) {
    const std::string text = read_text("docs/architecture.md");
    const std::regex row("\\n\\| " + first_cell + " \\|(?:[^|\\n]*\\|)*? ([^|\\n]*) \\|(?=\\n)");
    std::map<std::string, std::string> cells;
    for (std::sregex_iterator it(text.begin(), text.end(), row), end; it != end; ++it) {
        cells[(*it)[1]] = (*it)[2];
    }
    return cells;
}

TEST(Libraries, FoldersUseOnlyThoseOfTheirRow) {
    const auto named = last_cells("`([a-z/]+)`");
    ASSERT_GT(named.size(), 15u);
    for (const auto& [library, files] : find_users()) {
        for (const std::string& file : files) {
            fs::path folder = fs::path(file).parent_path();
            while (!folder.empty() && !named.contains(folder.generic_string())) {
                folder = folder.parent_path();
            }
            ASSERT_FALSE(folder.empty()) << file;
            EXPECT_NE(named.at(folder.generic_string()).find(library), std::string::npos)
                << file << " includes " << library << ", which its row does not name";
        }
    }
}

TEST(Libraries, OnlyTheNamedFilesIncludeThoseWithVersions) {
    const auto named = last_cells("([A-Za-z][A-Za-z0-9]+)");
    const auto users = find_users();
    const std::regex path("`([^`]+)`");
    size_t checked = 0;
    for (const auto& [library, cell] : named) {
        if (!users.contains(library)) continue;
        Files files;
        for (std::sregex_iterator it(cell.begin(), cell.end(), path), end; it != end; ++it) {
            files.insert((*it)[1]);
        }
        EXPECT_EQ(users.at(library), files) << library;
        ++checked;
    }
    EXPECT_GE(checked, 8u);
}

}  // namespace
}  // namespace tetralight
