// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/partial_bake.h>

namespace tetralight {

/// Where a bake is kept while it is not finished.
struct BakeKeeping {
    /// The file that it is written to every `save_seconds` or more, and when it is cancelled;
    /// empty: none.
    std::string path;
    /// Goes on with what that file holds, when there is one.
    bool is_resumed = false;
    double save_seconds = 30.0;
};

struct RangeBake {
    PartialBake partial;
    /// Rays that were traced before this run.
    uint64_t earlier_ray_count = 0;
    /// The kept file is there, and of no use when the bake's own file is written.
    bool is_kept = false;
    /// Why the bake could not be kept, when it could not.
    std::string warning;
};

/// Bakes the probes of a range to the end. When the callback cancels it, the error says "cancelled"
/// and the bake is kept. Errors beside those of `bake_accumulators`: the range is not within the
/// volume; the kept file cannot be read, is of another bake, or of another range.
[[nodiscard]] Result<RangeBake> bake_range(const Scene& scene, const PreparedBake& prepared,
                                           ProbeRange range, const BakeKeeping& keeping,
                                           const BakeCallback& callback = {});

}  // namespace tetralight
