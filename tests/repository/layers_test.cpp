// SPDX-License-Identifier: Apache-2.0
// The folder table of docs/architecture.md as a test.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/repository/source_files.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = TETRALIGHT_SOURCE_DIR;

using Folders = std::set<std::string>;

/// The words of a table's cell, or of a list: "`bake/rays`, base" are bake/rays and base.
std::vector<std::string> folders_in(const std::string& cell) {
    const std::regex name("[a-z]+(?:/[a-z]+)*");
    std::vector<std::string> found;
    for (std::sregex_iterator it(cell.begin(), cell.end(), name), end; it != end; ++it) {
        found.push_back(it->str());
    }
    return found;
}

/// What a row's second cell names: folders, or "everything above", perhaps "but" some.
Folders allowed_by(const std::string& cell, const Folders& above) {
    const std::string everything = "everything above";
    const std::string list = cell.substr(0, cell.find(';'));
    if (!list.starts_with(everything)) {
        const auto named = folders_in(list);
        return {named.begin(), named.end()};
    }
    Folders allowed = above;
    for (const std::string& left_out : folders_in(list.substr(everything.size()))) {
        allowed.erase(left_out);
    }
    return allowed;
}

/// The table in docs/architecture.md: what each folder may include beside itself.
std::map<std::string, Folders> read_folder_table() {
    std::ifstream page(kRoot / "docs/architecture.md");
    const std::regex row("^\\| `([a-z/]+)` \\| ([^|]*) \\|.*");
    std::map<std::string, Folders> table;
    Folders above;
    std::smatch match;
    for (std::string line; std::getline(page, line);) {
        if (!std::regex_match(line, match, row)) continue;
        table[match[1]] = allowed_by(match[2], above);
        above.insert(match[1]);
    }
    return table;
}

const std::map<std::string, Folders> kMayInclude = read_folder_table();

/// The folder of the table that a path from the root lies in; empty for none.
std::string folder_of(const fs::path& path) {
    for (fs::path folder = path.parent_path(); !folder.empty(); folder = folder.parent_path()) {
        if (kMayInclude.contains(folder.generic_string())) return folder.generic_string();
    }
    return {};
}

/// The headers that a file includes with this opening bracket: `<` or `"`.
std::vector<std::string> includes_of(const fs::path& file, const std::string& bracket) {
    const std::string text = read_text(file);
    const std::regex include("(?:^|\\n)[ \\t]*#[ \\t]*include[ \\t]*" + bracket + "([^>\"\\n]+)");
    std::vector<std::string> headers;
    for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
        headers.push_back((*it)[1]);
    }
    return headers;
}

/// Calls `visit(file)` for each source file of the folders in the table, once.
template <class Visit>
void for_each_source(Visit visit) {
    for (const auto& [folder, allowed] : kMayInclude) {
        for (const fs::path& file : source_files(folder)) {
            if (folder_of(file) == folder) visit(file);
        }
    }
}

/// Calls `visit(file, included)` for each #include <tetralight/...>.
template <class Visit>
void for_each_include(Visit visit) {
    const std::string prefix = "tetralight/";
    for_each_source([&](const fs::path& file) {
        for (const std::string& header : includes_of(file, "<")) {
            if (header.starts_with(prefix)) visit(file, fs::path(header.substr(prefix.size())));
        }
    });
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

TEST(Layers, OwnHeadersAreIncludedUnderTheirPrefix) {
    for_each_source([](const fs::path& file) {
        for (const std::string& header : includes_of(file, "\"")) {
            ADD_FAILURE() << file << " includes " << header << " in quotes";
        }
    });
}

TEST(Layers, IncludedHeadersExist) {
    for_each_include([](const fs::path& file, const fs::path& included) {
        EXPECT_TRUE(fs::exists(kRoot / included)) << file << " includes " << included;
    });
}

TEST(Layers, TheTableNamesFoldersThatExist) {
    EXPECT_GT(kMayInclude.size(), 15u);
    for (const auto& [folder, allowed] : kMayInclude) {
        EXPECT_TRUE(fs::is_directory(kRoot / folder)) << folder;
        for (const std::string& lower : allowed) {
            EXPECT_TRUE(kMayInclude.contains(lower)) << folder << " may include " << lower;
        }
    }
}

/// True if `from` may include `to`, directly or through other folders.
bool reaches(const std::string& from, const std::string& to, Folders& seen) {
    for (const std::string& lower : kMayInclude.at(from)) {
        if (lower == to) return true;
        if (seen.insert(lower).second && reaches(lower, to, seen)) return true;
    }
    return false;
}

TEST(Layers, TheTableHasNoCycle) {
    for (const auto& [folder, allowed] : kMayInclude) {
        Folders seen;
        EXPECT_FALSE(reaches(folder, folder, seen)) << folder << " may include itself";
    }
}

TEST(Layers, NoTwoFoldersIncludeEachOther) {
    std::set<std::pair<std::string, std::string>> edges;
    for_each_include([&](const fs::path& file, const fs::path& included) {
        edges.emplace(folder_of(file), folder_of(included));
    });
    for (const auto& [from, to] : edges) {
        EXPECT_TRUE(from == to || !edges.contains({to, from})) << from << " and " << to;
    }
}

TEST(Layers, EverySourceSaysItsLicenceFirst) {
    const std::string licence = "// SPDX-License-Identifier: Apache-2.0\n";
    for (const std::string& folder : source_folders()) {
        for (const fs::path& file : source_files(folder)) {
            EXPECT_TRUE(read_text(file).starts_with(licence)) << file;
        }
    }
}

}  // namespace
}  // namespace tetralight
