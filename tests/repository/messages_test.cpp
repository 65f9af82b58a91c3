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
    "base/error.cpp",
    "base/error_text.h",
    "cli/common.cpp",
    "cli/failure.cpp",
    "server/problem.cpp",
    "runtime/detail/c_errors.cpp",
};

/// Files that still have to change. Nothing may be added here.
const std::set<std::string> kStillToChange = {
    "bake/placement/adaptive_grid.cpp",
    "bake/scene/detail/gltf_document.cpp",
    "bake/scene/probe_groups_json.cpp",
    "cli/bake.cpp",
    "cli/grid_options.cpp",
    "cli/group_files.cpp",
    "cli/lppv.cpp",
    "cli/lppv_grid_options.cpp",
    "cli/main.cpp",
    "cli/open_gl.cpp",
    "cli/position_handler.cpp",
    "cli/position_text.cpp",
    "cli/render.cpp",
    "cli/validate.cpp",
    "pipeline/resumable_bake.cpp",
    "probes/detail/verify_text.cpp",
    "server/json.cpp",
    "server/open_volumes.cpp",
    "server/query_routes.cpp",
    "server/store.cpp",
    "server/tool_problem.cpp",
    "server/tool_routes.cpp",
};

bool may_print(const fs::path& file) {
    const std::string folder = file.begin()->string();
    return folder == "tests" || folder == "bench" || folder == "examples" ||
           kPrinters.contains(file.generic_string()) ||
           kStillToChange.contains(file.generic_string());
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

/// Shortens the text of a library's exception before it becomes a message.
const std::string kShortensExceptions = "base/json/json_text.cpp";

TEST(Messages, NoSourceSearchesThem) {
    const std::string text = "(?:message|error_text\\([^;]*\\)|what\\(\\)|stderr_text)(?:\\(\\))?";
    const std::string search =
        "(?:\\.find|\\.rfind|\\.contains|\\.starts_with|\\.ends_with|\\.compare)";
    const std::regex branches("\\b" + text + "\\)*\\s*(?:" + search + "\\(|[=!]=)");
    for (const std::string& folder : source_folders()) {
        if (folder == "tests") continue;
        for (const fs::path& file : source_files(folder)) {
            if (kStillToChange.contains(file.generic_string())) continue;
            if (file == kShortensExceptions) continue;
            std::smatch match;
            const std::string code = without_comments_and_strings(read_text(file));
            EXPECT_FALSE(std::regex_search(code, match, branches)) << file << ": " << match.str();
        }
    }
}

}  // namespace
}  // namespace tetralight
