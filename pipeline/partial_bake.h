// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/place_range.h>
#include <tetralight/pipeline/reused_light.h>
#include <tetralight/probes/probe_file.h>

// Parts: ranges of one bake, for `merge_parts`. A part is a `.probes` file whose probes have no
// light yet, with the accumulators of a range in sections of their own (docs/file_format.md).

namespace tetralight {

/// The finished bake of a range.
struct PartialBake {
    PlaceRange range;
    /// One for each probe of the range; empty ones where light is reused.
    std::vector<ProbeAccumulator> accumulators;
    /// A row for each accumulator, if the plan has light groups (`LightGroupRows`).
    std::vector<double> split_rows{};
    /// Light of probes of the range.
    ReusedLight reused{};

    bool operator==(const PartialBake&) const = default;
};

/// A part that was read from a file.
struct PartFile {
    std::string path;
    PartialBake partial;
    /// The members that `finish_bake` needs: without the report, the capture positions, and
    /// settings that only `key` depends on.
    PreparedBake prepared;
};

/// True if an open file has the sections of a part.
[[nodiscard]] bool is_part(const ProbeFile& file) noexcept;

/// Writes a part; the old file stays whole on failure.
[[nodiscard]] Status write_part(const std::string& path, const PreparedBake& prepared,
                                const PartialBake& partial);

/// Reads a part and verifies all of it, as `open_probe_file` does, and that rounds can give these
/// accumulators. Errors name the path.
[[nodiscard]] Result<PartFile> read_part(const std::string& path);

}  // namespace tetralight
