// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/light_pool.h>

#include <map>
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
    wanted_samples_.push_back(kMinSamples);
    return static_cast<uint32_t>(positions_.size() - 1);
}

bool LightPool::double_samples(uint32_t i) {
    if (wanted_samples_[i] >= kMaxSamples) return false;
    wanted_samples_[i] *= 2;
    return true;
}

uint64_t LightPool::sample_count() const {
    uint64_t count = 0;
    for (const ProbeAccumulator& accumulator : accumulators_) count += accumulator.sample_count;
    return count;
}

uint64_t LightPool::ray_count() const {
    uint64_t count = 0;
    for (const ProbeAccumulator& accumulator : accumulators_) count += accumulator.ray_count;
    return count;
}

Status LightPool::bake(const BakeCallback& callback) {
    accumulators_.resize(positions_.size());
    light_.resize(positions_.size());
    std::map<uint32_t, std::vector<uint32_t>> missing;  // by the samples that they want
    bool is_change = false;
    for (uint32_t i = 0; i < positions_.size(); ++i) {
        const uint64_t known = accumulators_[i].sample_count;
        if (known >= wanted_samples_[i]) continue;
        missing[wanted_samples_[i]].push_back(i);
        is_change = is_change || known > 0;
    }
    if (is_change) ++version_;
    for (const auto& [sample_count, some] : missing) {
        if (auto status = bake_some(some, sample_count, callback); !status) return status;
    }
    return Ok{};
}

Status LightPool::bake_some(std::span<const uint32_t> some, uint32_t sample_count,
                            const BakeCallback& callback) {
    settings_.max_sample_count = sample_count;
    std::vector<glm::dvec3> positions;
    std::vector<ProbeAccumulator> accumulators;
    for (const uint32_t i : some) {
        positions.push_back(positions_[i]);
        accumulators.push_back(accumulators_[i]);
    }
    auto status =
        bake_accumulators(scene_, {positions}, settings_, accumulators, {.progress = callback});
    if (!status) return status;
    for (size_t k = 0; k < some.size(); ++k) {
        accumulators_[some[k]] = accumulators[k];
        light_[some[k]] = irradiance_from_radiance(accumulators[k].radiance());
    }
    return Ok{};
}

}  // namespace tetralight
