// SPDX-License-Identifier: Apache-2.0
// Programs branch on an error's code and field, never on its text.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "tests/repository/source_files.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

/// The files that turn messages into text for people. Tests, benchmarks and examples may too.
const std::set<std::string> kPrinters = {
    "base/error.cpp",  "base/error_text.h",  "cli/common.cpp",
    "cli/failure.cpp", "server/problem.cpp", "runtime/detail/c_errors.cpp",
};

bool may_print(const fs::path& file) {
    const std::string folder = file.begin()->string();
    return folder == "tests" || folder == "bench" || folder == "examples" ||
           kPrinters.contains(file.generic_string());
}

TEST(Messages, OnlyPrintersIncludeErrorText) {
    for (const std::string& folder : source_folders()) {
        for (const fs::path& file : source_files(folder)) {
            if (may_print(file)) continue;
            EXPECT_EQ(read_text(file).find("<tetralight/base/error_text.h>"), std::string::npos)
                << file << " turns an error into text";
        }
    }
}

/// These shorten the text of a library's exception before it becomes a message.
const std::set<std::string> kShortenExceptions = {"base/json/json_text.cpp",
                                                  "cli/position_handler.cpp"};

TEST(Messages, NoSourceSearchesThem) {
    const std::string text = "(?:message|error_text\\([^;]*\\)|what\\(\\)|stderr_text)(?:\\(\\))?";
    const std::string search =
        "(?:\\.find|\\.rfind|\\.contains|\\.starts_with|\\.ends_with|\\.compare)";
    const std::regex branches("\\b" + text + "\\)*\\s*(?:" + search + "\\(|[=!]=)");
    for (const std::string& folder : source_folders()) {
        if (folder == "tests") continue;
        for (const fs::path& file : source_files(folder)) {
            if (kShortenExceptions.contains(file.generic_string())) continue;
            std::smatch match;
            const std::string code = without_comments_and_strings(read_text(file));
            EXPECT_FALSE(std::regex_search(code, match, branches)) << file << ": " << match.str();
        }
    }
}

}  // namespace
}  // namespace tetralight
