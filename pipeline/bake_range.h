// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/partial_bake.h>
#include <tetralight/pipeline/stored_bake.h>

// Bakes the probes of a range whose light is not known yet:
//
//     prepare_bake → [reuse_probes] → bake_range → finish_bake, or write_part → merge_parts
//
// The bytes are those of a bake of all probes at once, whatever was reused, found in stores, or
// baked by other machines.

namespace tetralight {

struct RangeBake {
    PartialBake partial;
    StoredBake stored;
};

/// Looks at the light of a range while it is baked.
struct RangePreview {
    /// Called with the light so far on the thread of the bake; empty: no previews.
    std::function<void(const PartialBake& so_far)> show{};
    /// Time between two calls, or more: previews take at most a fiftieth of the time.
    double seconds = 2.0;
};

/// Bakes the probes of a range to the end. Returns invalid_argument (field "probes") if the range
/// is not within the volume, cancelled if the callback returns false, else errors of
/// `bake_accumulators`.
[[nodiscard]] Result<RangeBake> bake_range(const Scene& scene, const PreparedBake& prepared,
                                           PlaceRange range, const BakeStorage& storage = {},
                                           const BakeCallback& callback = {},
                                           const RangePreview& preview = {});

}  // namespace tetralight
