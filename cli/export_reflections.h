// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {

/// What `tetralight export` writes of a file of reflection probes.
struct ReflectionExport {
    std::string path;
    std::string output;
    /// Names of the probes, or their numbers in the file, from 0. Empty: all as images; the sky, or
    /// the only probe, as a light.
    std::vector<std::string> probes;
    /// Of a light.
    std::string scene_path;
    /// Of images; 0: as a mirror shows it.
    uint32_t level = 0;
};

/// Writes one OpenEXR file a probe, at its `page_path`: the six faces of a level, one below the
/// other. Returns not_found for a probe or a level that is not there.
[[nodiscard]] Status export_reflection_images(const ReflectionExport& what,
                                              const CommonOptions& common);

/// Writes the scene with one probe as its image-based light. Returns not_found for a probe that is
/// not there, and the errors of `write_reflection_glb`. Precondition: at most one probe is named.
[[nodiscard]] Status export_reflection_scene(const ReflectionExport& what,
                                             const CommonOptions& common);

}  // namespace tetralight::cli
