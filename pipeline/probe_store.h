// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_store.h>

namespace tetralight {

/// Accumulators and light-group rows of probes or texels in bake stores. The key is SHA-256 of what
/// the light depends on: what the bake reads of the scene, the settings, the program's version, the
/// capture position, and the occlusion lights of a probe or the surface and the cache of a texel.
/// So probes of other groups and other volumes are found too. The value is the newest state of the
/// probe, finished or not: a bake goes on from there.
class ProbeStore {
  public:
    /// `places` and `split` as of `bake_accumulators`; they outlive this object.
    ProbeStore(const Scene& scene, const BakeSettings& settings, const BakePlaces& places,
               std::span<ProbeAccumulator> accumulators, const LightGroupRows& split);

    /// Loads the state of each probe that has had more rounds in the store than here. `is_target`:
    /// it is the store that `save` will write to.
    void load(BakeStore& store, bool is_target);

    /// Puts all probes that have changed since they were loaded or saved.
    [[nodiscard]] Status save(BakeStore& store);

  private:
    [[nodiscard]] std::span<double> row(size_t probe) const;

    std::vector<StoreKey> keys_;
    std::span<ProbeAccumulator> accumulators_;
    std::span<double> rows_;
    size_t row_size_ = 0;
    BakeSettings settings_;
    ErrorMeasure measure_;
    std::vector<uint64_t> stored_rounds_;  ///< one a probe
};

}  // namespace tetralight
