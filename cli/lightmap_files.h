// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/common.h>
#include <tetralight/lightmap/lightmap_file.h>

// What commands do with `.lightmaps` files.

namespace tetralight::cli {

/// True if the file begins as lightmaps do.
[[nodiscard]] bool is_lightmap_file(const std::string& path);

/// Refuses to write `contents` ("probes", "lightmaps", "reflection probes") to a file whose
/// extension is that of another of these.
[[nodiscard]] Status check_output_kind(const std::string& input, const std::string& output,
                                       std::string_view contents);

/// Opens the lightmaps at a path; without a path there are none.
[[nodiscard]] Result<std::optional<LightmapFile>> open_lightmaps(const std::string& path);

/// The files that light a picture.
struct LightPaths {
    std::string scene, volume, lightmaps;
};

/// An error of `make_scene_light` with the files that it is about.
[[nodiscard]] Error in_light_files(const Error& error, const LightPaths& paths);

/// Prints what lightmaps hold: pages, objects, layers, errors and how they were made.
[[nodiscard]] Status show_lightmaps(const std::string& path, const CommonOptions& common);

/// Checks all of a file and prints the verdict.
[[nodiscard]] Status validate_lightmaps(const std::string& path, const CommonOptions& common);

/// How `relight` changes lightmaps.
struct LightmapChange {
    std::vector<std::pair<std::string, float>> weights;
    /// Empty: no blending.
    std::string blend_path;
    float blend_share = 0.5f;
};

[[nodiscard]] Status relight_lightmap_file(const std::string& path, const std::string& output,
                                           const LightmapChange& change,
                                           const CommonOptions& common);

}  // namespace tetralight::cli
