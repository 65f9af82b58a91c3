// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// Light at positions that are added one by one. It is baked with few samples at first and with
/// more on demand; earlier samples are kept.
class LightPool {
  public:
    /// The first and the maximum number of samples of a position.
    static constexpr uint32_t kMinSamples = 128;
    static constexpr uint32_t kMaxSamples = 4096;

    /// Keeps a reference to the scene. Ignores the sample counts of the settings.
    LightPool(const Scene& scene, BakeSettings settings);

    /// Returns the index of a new position, which has no light yet.
    uint32_t add(const glm::dvec3& position);

    [[nodiscard]] size_t size() const { return positions_.size(); }

    [[nodiscard]] const glm::dvec3& position(uint32_t i) const { return positions_[i]; }

    [[nodiscard]] const IrradianceSh& light(uint32_t i) const { return light_[i]; }

    /// Standard error of the light, as a fraction of it.
    [[nodiscard]] float standard_error(uint32_t i) const {
        return accumulators_[i].standard_error();
    }

    [[nodiscard]] uint32_t sample_count() const { return sample_count_; }

    [[nodiscard]] uint64_t ray_count() const;

    /// Bakes new positions with as many samples as the others have. Errors: those of
    /// `bake_accumulators`.
    [[nodiscard]] Status bake(const BakeCallback& callback);

    /// Doubles the samples of all positions. Returns false if they have the maximum number.
    bool double_sample_count();

  private:
    const Scene& scene_;
    BakeSettings settings_;
    uint32_t sample_count_ = kMinSamples;
    std::vector<glm::dvec3> positions_;
    std::vector<ProbeAccumulator> accumulators_;
    std::vector<IrradianceSh> light_;
};

}  // namespace tetralight
