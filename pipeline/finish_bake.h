// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/partial_bake.h>

namespace tetralight {

/// The last step of a bake (`finish_bake`) for light that comes in ranges, of which only one is in
/// memory: accumulators are larger than the light that they stand for.
class BakeFinisher {
  public:
    explicit BakeFinisher(PreparedBake prepared);

    /// Takes the light of a range and, if light was split, a row for each of its probes.
    /// Precondition: they are probes of the bake, and none was added before.
    void add(const PlaceRange& range, std::span<const ProbeAccumulator> accumulators,
             std::span<const double> split_rows);

    /// The same with the light that the range reuses.
    void add(const PartialBake& partial);

    /// What is being finished; its volume has the light so far.
    [[nodiscard]] const PreparedBake& prepared() const { return prepared_; }

    /// What `finish_bake` returns. Precondition: each probe was added.
    [[nodiscard]] BakedVolume finish() &&;

  private:
    PreparedBake prepared_;
    BakedProbes light_;  ///< errors and samples; the light itself lies in the volume
    size_t added_count_ = 0;
};

}  // namespace tetralight
