// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/probe_store.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include <tetralight/bake/round_plan.h>
#include <tetralight/base/contract.h>
#include <tetralight/pipeline/bake_key.h>
#include <tetralight/pipeline/check_accumulator.h>

namespace tetralight {
namespace {

StoreKey probe_key_of(const StoreKey& light, const glm::dvec3& position,
                      const OcclusionLights* occlusion) {
    Sha256 hash;
    hash.add(light);
    hash.add(std::as_bytes(std::span(&position, 1)));
    if (occlusion != nullptr) hash.add(std::as_bytes(std::span(occlusion, 1)));
    return hash.digest();
}

StoreKey texel_key_of(const StoreKey& light, uint64_t cache_key, const glm::dvec3& position,
                      const TexelSurface& surface) {
    Sha256 hash;
    hash.add(std::string_view("texel"));
    hash.add(light);
    hash.add(std::as_bytes(std::span(&cache_key, 1)));
    hash.add(std::as_bytes(std::span(&position, 1)));
    hash.add(std::as_bytes(std::span(&surface.normal, 1)));
    hash.add(std::as_bytes(surface.origins));
    return hash.digest();
}

}  // namespace

ProbeStore::ProbeStore(const Scene& scene, const BakeSettings& settings, const BakePlaces& places,
                       std::span<ProbeAccumulator> accumulators, const LightGroupRows& split)
    : accumulators_(accumulators),
      rows_(split.rows),
      row_size_(LightGroupLayout(settings.plan).size()),
      settings_(settings),
      measure_(places.measure()),
      stored_rounds_(places.positions.size(), 0) {
    TETRALIGHT_ASSERT(accumulators.size() == places.positions.size(), "one accumulator a place");
    const StoreKey light = light_key(scene, settings);
    for (size_t i = 0; i < places.positions.size(); ++i) {
        const glm::dvec3& position = places.positions[i];
        if (measure_ == ErrorMeasure::OwnNormal) {
            keys_.push_back(
                texel_key_of(light, places.surfaces.cache_key, position, places.surfaces[i]));
            continue;
        }
        const bool has_occlusion = settings.plan.has_occlusion;
        keys_.push_back(
            probe_key_of(light, position, has_occlusion ? &split.occlusion_lights[i] : nullptr));
    }
}

std::span<double> ProbeStore::row(size_t probe) const {
    return rows_.subspan(probe * row_size_, row_size_);
}

void ProbeStore::load(BakeStore& store, bool is_target) {
    const RoundPlan plan(settings_, measure_);
    for (size_t i = 0; i < keys_.size(); ++i) {
        const auto value = store.find(keys_[i]);
        if (!value || value->size() != sizeof(ProbeAccumulator) + row(i).size_bytes()) continue;
        ProbeAccumulator found;
        std::memcpy(&found, value->data(), sizeof found);
        std::vector<double> found_row(row_size_);
        if (row_size_ > 0) {
            std::memcpy(found_row.data(), value->data() + sizeof found, row(i).size_bytes());
        }
        const auto is_finite = [](double number) { return std::isfinite(number); };
        if (found.round_count <= accumulators_[i].round_count || !is_possible(found, plan) ||
            !std::ranges::all_of(found_row, is_finite)) {
            continue;
        }
        accumulators_[i] = found;
        std::ranges::copy(found_row, row(i).begin());
        if (is_target) stored_rounds_[i] = found.round_count;
    }
}

Status ProbeStore::save(BakeStore& store) {
    std::vector<size_t> changed;
    for (size_t i = 0; i < keys_.size(); ++i) {
        if (accumulators_[i].round_count > stored_rounds_[i]) changed.push_back(i);
    }
    const size_t size = sizeof(ProbeAccumulator) + row_size_ * sizeof(double);
    std::vector<std::byte> bytes(changed.size() * size);
    std::vector<StoreEntry> entries;
    for (const size_t i : changed) {
        const auto value = std::span(bytes).subspan(entries.size() * size, size);
        std::memcpy(value.data(), &accumulators_[i], sizeof(ProbeAccumulator));
        std::ranges::copy(std::as_bytes(row(i)), value.begin() + sizeof(ProbeAccumulator));
        entries.push_back({keys_[i], value});
    }
    if (auto status = store.put(entries); !status) return status;
    for (const size_t i : changed) stored_rounds_[i] = accumulators_[i].round_count;
    return Ok{};
}

}  // namespace tetralight
