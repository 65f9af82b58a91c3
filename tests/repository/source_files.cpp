// SPDX-License-Identifier: Apache-2.0
#include "tests/repository/source_files.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

namespace tetralight {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = TETRALIGHT_SOURCE_DIR;

/// Where the comment or literal that begins at `begin` ends; `begin` if none begins there.
size_t end_of_comment_or_literal(const std::string& text, size_t begin) {
    const auto end_after = [&](const std::string& closing, size_t from) {
        const size_t found = text.find(closing, from);
        return found == std::string::npos ? text.size() : found + closing.size();
    };
    if (text.compare(begin, 2, "//") == 0) return std::min(text.find('\n', begin), text.size());
    if (text.compare(begin, 2, "/*") == 0) return end_after("*/", begin + 2);
    if (text.compare(begin, 2, "R\"") == 0) {
        const size_t open = text.find('(', begin);
        return end_after(")" + text.substr(begin + 2, open - begin - 2) + "\"", open);
    }
    const char quote = text[begin];
    if (quote != '"' && quote != '\'') return begin;
    const bool is_digit_separator = quote == '\'' && begin > 0 && std::isxdigit(text[begin - 1]);
    if (is_digit_separator) return begin;
    size_t end = begin + 1;
    while (end < text.size() && text[end] != quote) end += text[end] == '\\' ? 2 : 1;
    return std::min(end + 1, text.size());
}

/// Files for which `is_wanted(path)`, relative to the repository and sorted.
template <class IsWanted>
std::vector<fs::path> files_below(const fs::path& folder, IsWanted is_wanted) {
    std::vector<fs::path> files;
    for (auto entry = fs::recursive_directory_iterator(kRoot / folder);
         entry != fs::recursive_directory_iterator(); ++entry) {
        const fs::path& path = entry->path();
        if (path.filename() == "node_modules" || path.filename() == "build") {
            entry.disable_recursion_pending();
        }
        if (is_wanted(path)) files.push_back(fs::relative(path, kRoot));
    }
    std::ranges::sort(files);
    return files;
}

}  // namespace

std::string read_text(const fs::path& path) {
    std::ifstream stream(kRoot / path);
    return (std::ostringstream() << stream.rdbuf()).str();
}

std::vector<fs::path> source_files(const fs::path& folder) {
    return files_below(folder, [](const fs::path& path) {
        return path.extension() == ".h" || path.extension() == ".cpp";
    });
}

std::vector<fs::path> build_files(const fs::path& folder) {
    return files_below(folder,
                       [](const fs::path& path) { return path.filename() == "CMakeLists.txt"; });
}

std::vector<std::string> source_folders() {
    std::vector<std::string> folders;
    for (const auto& entry : fs::directory_iterator(kRoot)) {
        const std::string name = entry.path().filename().string();
        const bool is_ours = entry.is_directory() && name[0] != '.' && name != "build";
        if (is_ours && fs::exists(entry.path() / "CMakeLists.txt")) folders.push_back(name);
    }
    std::ranges::sort(folders);
    return folders;
}

std::string without_comments_and_strings(const std::string& text) {
    std::string result = text;
    for (size_t i = 0; i < text.size();) {
        const size_t end = end_of_comment_or_literal(text, i);
        for (size_t j = i; j < end; ++j) {
            if (text[j] != '\n') result[j] = ' ';
        }
        i = std::max(end, i + 1);
    }
    return result;
}

}  // namespace tetralight
