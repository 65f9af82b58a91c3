// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/light_pool.h>

#include <utility>

#include <tetralight/bake/bake_accumulators.h>

namespace tetralight {

LightPool::LightPool(const Scene& scene, BakeSettings settings)
    : scene_(scene), settings_(std::move(settings)) {
    settings_.sample_count = kMinSamples;
    // Never reached: rounds double until the maximum number of samples.
    settings_.target_error = 1e-9;
    settings_.time_budget_seconds = 0.0;
}

uint32_t LightPool::add(const glm::dvec3& position) {
    positions_.push_back(position);
    return static_cast<uint32_t>(positions_.size() - 1);
}

uint64_t LightPool::ray_count() const {
    uint64_t count = 0;
    for (const ProbeAccumulator& accumulator : accumulators_) count += accumulator.ray_count;
    return count;
}

Status LightPool::bake(const BakeCallback& callback) {
    settings_.max_sample_count = sample_count_;
    accumulators_.resize(positions_.size());
    std::vector<uint32_t> missing;
    for (uint32_t i = 0; i < accumulators_.size(); ++i) {
        if (accumulators_[i].sample_count < sample_count_) missing.push_back(i);
    }
    if (missing.empty()) return Ok{};
    std::vector<glm::dvec3> positions;
    std::vector<ProbeAccumulator> accumulators;
    for (const uint32_t i : missing) {
        positions.push_back(positions_[i]);
        accumulators.push_back(accumulators_[i]);
    }
    auto status =
        bake_accumulators(scene_, positions, settings_, accumulators, {.progress = callback});
    if (!status) return status;
    light_.resize(positions_.size());
    for (size_t k = 0; k < missing.size(); ++k) {
        accumulators_[missing[k]] = accumulators[k];
        light_[missing[k]] = irradiance_from_radiance(accumulators[k].radiance());
    }
    return Ok{};
}

bool LightPool::double_sample_count() {
    if (sample_count_ >= kMaxSamples) return false;
    sample_count_ *= 2;
    return true;
}

}  // namespace tetralight
