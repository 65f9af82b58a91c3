// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_store.h>

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
    /// Of lightmaps: the store of their radiance cache, which is made if it is not there; null: it
    /// is made and not kept.
    BakeStore* cache = nullptr;
};

/// What a bake adds its samples to.
struct BakeSums {
    std::span<ProbeAccumulator> accumulators;
    LightGroupRows rows{};
};

struct StoredBake {
    /// Rays of earlier runs, whose results were loaded.
    uint64_t earlier_ray_count = 0;
    /// True if anything was saved to the target.
    bool is_saved = false;
    /// Why the last save failed, if it did.
    std::optional<Error> save_failure;
    /// Samples of the places that are not done, if the time budget ended the bake.
    std::optional<uint64_t> samples_in_time;
};

/// Bakes places to the end: loads what stores know of them, samples the rest, and saves it on the
/// way. The sums are those of a bake without stores. Returns cancelled if the callback returns
/// false, else errors of `bake_accumulators`, and that of a save if saving is required. Of the
/// hooks, `progress`, `begin` and those of previews are called.
[[nodiscard]] Result<StoredBake> bake_with_stores(const Scene& scene, const BakePlaces& places,
                                                  const BakeSettings& settings,
                                                  const BakeStorage& storage, const BakeSums& sums,
                                                  BakeHooks hooks = {});

}  // namespace tetralight
