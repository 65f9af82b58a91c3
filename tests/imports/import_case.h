// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include <tetralight/base/error_text.h>
#include <tetralight/imports/import_groups.h>
#include "tests/support/temp_folder.h"

namespace tetralight {

/// Reads a text as a file of this name, as `--groups` does.
inline Result<ImportedGroups> import_text(const std::string& name, std::string_view text) {
    const TempFolder folder;
    return import_groups(folder.write(name, text));
}

/// The groups of a text that has to be read.
inline ImportedGroups sound_import(const std::string& name, std::string_view text) {
    auto imported = import_text(name, text);
    EXPECT_TRUE(imported) << error_text(imported.error());
    return imported ? std::move(*imported) : ImportedGroups{};
}

/// From the name of the file on.
inline std::string from_name(const std::string& text, const std::string& name) {
    return text.substr(std::min(text.find(name), text.size()));
}

/// The message of a text that has to be refused, from the name of the file on.
inline std::string import_error(const std::string& name, std::string_view text) {
    const auto imported = import_text(name, text);
    if (imported) return "(no error)";
    return from_name(error_text(imported.error()), name);
}

}  // namespace tetralight
