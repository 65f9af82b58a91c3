// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/common.h>
#include <tetralight/reflection/reflections.h>

// What commands do with files of reflection probes (.ktx2).

namespace tetralight::cli {

/// True if the file begins as KTX 2.0 textures do, which may be of something else.
[[nodiscard]] bool is_reflection_file(const std::string& path);

/// One line a probe under a line of titles: name, position, size of the box, validity. No line
/// break at the end.
[[nodiscard]] std::string reflection_table(std::span<const ReflectionProbe> probes,
                                           std::span<const std::string_view> names);

/// Prints what reflection probes hold: cubes, places, boxes and how they were made.
[[nodiscard]] Status show_reflections(const std::string& path, const CommonOptions& common);

/// Writes reflection probes with new weights of layers to another file.
[[nodiscard]] Status relight_reflection_file(
    const std::string& path, const std::string& output,
    const std::vector<std::pair<std::string, float>>& weights, const CommonOptions& common);

/// Checks all of a file and prints the verdict.
[[nodiscard]] Status validate_reflections(const std::string& path, const CommonOptions& common);

}  // namespace tetralight::cli
