// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// Light at positions that are added one by one. It is baked with few samples at first and, where
/// it is asked for, with more; earlier samples are kept.
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

    /// Sampling error of the light, as a fraction of it.
    [[nodiscard]] float standard_error(uint32_t i) const {
        return accumulators_[i].sampling_error();
    }

    /// Asks for twice the samples of a position. Returns false if it has the maximum number.
    bool double_samples(uint32_t i);

    /// Counts the calls of `bake` that changed light that was known before.
    [[nodiscard]] uint32_t version() const { return version_; }

    /// Of all positions.
    [[nodiscard]] uint64_t sample_count() const;
    [[nodiscard]] uint64_t ray_count() const;

    /// Bakes what is missing. Errors: those of `bake_accumulators`.
    [[nodiscard]] Status bake(const BakeCallback& callback);

  private:
    [[nodiscard]] Status bake_some(std::span<const uint32_t> some, uint32_t sample_count,
                                   const BakeCallback& callback);

    const Scene& scene_;
    BakeSettings settings_;
    std::vector<glm::dvec3> positions_;
    std::vector<uint32_t> wanted_samples_;
    std::vector<ProbeAccumulator> accumulators_;
    std::vector<IrradianceSh> light_;
    uint32_t version_ = 0;
};

}  // namespace tetralight
