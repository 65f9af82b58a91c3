// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include <tetralight/base/result.h>
#include <tetralight/cli/values.h>

namespace tetralight::cli {

/// An empty object if the file cannot be read or does not hold a JSON object.
[[nodiscard]] settings::Json read_object(const std::filesystem::path& path);

/// Writes indented JSON; the old file stays whole on failure.
[[nodiscard]] Status write_json(const std::filesystem::path& path, const settings::Json& json);

}  // namespace tetralight::cli
