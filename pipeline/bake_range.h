// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_store.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/partial_bake.h>

// Bakes the probes of a range whose light is not known yet:
//
//     prepare_bake → [reuse_probes] → bake_range → finish_bake, or write_part → merge_parts
//
// The bytes are those of a bake of all probes at once, whatever was reused, found in stores, or
// baked by other machines.

namespace tetralight {

/// Where a bake looks for known probes, and keeps its own.
struct BakeStorage {
    /// Stores to load from. The furthest state of a probe is taken.
    std::vector<BakeStore*> sources;
    /// The store that probes are saved to every `save_seconds` or more, and when the bake is
    /// cancelled or fails; nothing: none.
    BakeStore* target = nullptr;
    double save_seconds = 30.0;
    /// Also saves when the bake is finished.
    bool is_saved_at_end = false;
    /// Ends the bake with an error if it cannot be saved; else the bake goes on with a warning.
    bool is_required = false;
};

struct RangeBake {
    PartialBake partial;
    /// Rays of earlier runs, whose results were loaded.
    uint64_t earlier_ray_count = 0;
    /// True if anything was saved to the target.
    bool is_saved = false;
    /// Why the last save failed, if it did.
    std::optional<Error> save_failure;
};

/// Bakes the probes of a range to the end. Returns invalid_argument (field "probes") if the range
/// is not within the volume, cancelled if the callback returns false, else errors of
/// `bake_accumulators`.
[[nodiscard]] Result<RangeBake> bake_range(const Scene& scene, const PreparedBake& prepared,
                                           ProbeRange range, const BakeStorage& storage = {},
                                           const BakeCallback& callback = {});

}  // namespace tetralight
