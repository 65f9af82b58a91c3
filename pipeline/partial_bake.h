// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/probe_file.h>

// Bakes that are put aside, and ranges of bakes: a `.probes` file whose probes have no light yet,
// with what their rounds found so far beside it (docs/file_format.md).

namespace tetralight {

/// Probes [begin, end) of a volume, in its order.
struct ProbeRange {
    uint32_t begin = 0;
    uint32_t end = 0;

    [[nodiscard]] uint32_t count() const { return end - begin; }

    bool operator==(const ProbeRange&) const = default;
};

/// How far a bake of a range is.
struct PartialBake {
    ProbeRange range;
    /// One for each probe of the range.
    std::vector<ProbeAccumulator> accumulators;
    /// Nothing is left to do; with a time budget the accumulators alone do not tell.
    bool is_finished = false;
    /// A row for each accumulator, when light is split (`LightGroupRows`).
    std::vector<double> split_rows{};

    /// Probes that have had a round.
    [[nodiscard]] size_t begun_count() const;

    bool operator==(const PartialBake&) const = default;
};

/// A file of it.
struct PartFile {
    std::string path;
    PartialBake partial;
    /// What finishing needs of the bake: the report and the capture positions are left out, and of
    /// the settings what changes no round, which the key holds.
    PreparedBake prepared;
};

/// Whether an open file claims to be a part.
[[nodiscard]] bool is_part(const ProbeFile& file) noexcept;

/// Writes a part; the old file stays whole on failure.
[[nodiscard]] Status write_part(const std::string& path, const PreparedBake& prepared,
                                const PartialBake& partial);

/// Reads a part and verifies all of it: what every `.probes` file has to hold, and that
/// accumulators are what rounds can leave. Errors name the path.
[[nodiscard]] Result<PartFile> read_part(const std::string& path);

}  // namespace tetralight
