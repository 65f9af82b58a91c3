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
    /// Names of the probes; empty: all.
    std::vector<std::string> names;
    /// 0: as a mirror shows it.
    uint32_t level = 0;
};

/// Writes one OpenEXR file a probe, at its `page_path`: the six faces of a level, one below the
/// other. Returns not_found for a name or a level that is not there.
[[nodiscard]] Status export_reflection_images(const ReflectionExport& what,
                                              const CommonOptions& common);

}  // namespace tetralight::cli
