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

// Many parts of a large bake share one prepared bake, and hold its light alone.

/// Writes a part without probes, and the capture positions.
[[nodiscard]] Status write_prepared_bake(const std::string& path, const PreparedBake& prepared);

/// Reads what `write_prepared_bake` wrote for a bake of this scene with these settings; the report
/// is empty. Returns invalid_argument for another file or another bake. Errors name the path.
[[nodiscard]] Result<PreparedBake> read_prepared_bake(const std::string& path, const Scene& scene,
                                                      const BakeVolumeSettings& settings);

/// The same without its scene, for `BakeFinisher`: without the settings that only the key depends
/// on.
[[nodiscard]] Result<PreparedBake> read_prepared_bake(const std::string& path);

/// Writes the light of a range, without cells.
[[nodiscard]] Status write_light_part(const std::string& path, const PreparedBake& prepared,
                                      const PartialBake& partial);

/// The range that a part of a prepared bake has. Reads two pages of the file. Returns
/// invalid_argument if it is not the light of a part, or of another bake.
[[nodiscard]] Result<PlaceRange> light_part_range(const std::string& path,
                                                  const PreparedBake& prepared);

/// Reads and verifies what `write_light_part` wrote. Errors name the path.
[[nodiscard]] Result<PartialBake> read_light_part(const std::string& path,
                                                  const PreparedBake& prepared);

}  // namespace tetralight
