// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/pipeline/bake_lightmaps.h>

// Parts of lightmaps: ranges of the texels of one bake, for `merge_lightmap_parts`. A part is a
// `.lightmaps` file without pages, with the accumulators of a range in sections of their own
// (docs/file_format.md).

namespace tetralight {

/// A part that was read from a file.
struct LightmapPartFile {
    std::string path;
    TexelBake partial;
    /// The members that `finish_lightmaps` needs, and the key. The report has counts alone.
    PreparedLightmaps prepared;
};

/// True if an open file has the sections of a part.
[[nodiscard]] bool is_part(const LightmapFile& file) noexcept;

/// Writes a part; the old file stays whole on failure.
[[nodiscard]] Status write_lightmap_part(const std::string& path, const PreparedLightmaps& prepared,
                                         const TexelBake& partial);

/// Reads a part and verifies all of it, as `open_lightmap_file` does, and that rounds can give
/// these accumulators. Errors name the path.
[[nodiscard]] Result<LightmapPartFile> read_lightmap_part(const std::string& path);

}  // namespace tetralight
