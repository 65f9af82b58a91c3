// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/walk_facts.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <random>
#include <vector>

#include <tetralight/base/contract.h>
#include <tetralight/cli/common.h>
#include <tetralight/probes/locate.h>

namespace tetralight::cli {
namespace {

constexpr uint32_t kPositionCount = 10'000;

/// Random positions that are the same with every standard library.
class Positions {
  public:
    explicit Positions(const ProbeVolumeView& volume)
        : volume_(volume), bounds_(probe_bounds(volume)) {}

    glm::vec3 in_any_cell() {
        const Cell& cell = volume_.cells[engine_() % volume_.info.inner_cell_count];
        glm::dvec3 sum(0.0);
        double weight_sum = 0.0;
        for (const uint32_t probe : cell.vertices) {
            if (probe == kNoIndex) continue;
            const double weight = -std::log1p(-uniform());  // even in the cell once normalized
            sum += weight * glm::dvec3(volume_.positions[probe]);
            weight_sum += weight;
        }
        return in_world(sum / weight_sum);
    }

    glm::vec3 around() {
        const double x = uniform(), y = uniform(), z = uniform();
        const glm::dvec3 fractions = 1.1 * glm::dvec3(x, y, z) - 0.05;
        return in_world(glm::mix(glm::dvec3(bounds_.min), glm::dvec3(bounds_.max), fractions));
    }

  private:
    [[nodiscard]] glm::vec3 in_world(const glm::dvec3& local) const {
        return glm::vec3(local + volume_.info.world_origin);
    }

    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

    const ProbeVolumeView& volume_;
    Box<glm::vec3> bounds_;
    std::mt19937_64 engine_{1};
};

}  // namespace

WalkFacts measure_walks(const ProbeVolumeView& volume) {
    TETRALIGHT_ASSERT(volume.info.inner_cell_count > 0, "there are cells to walk");
    WalkFacts facts;
    facts.position_count = kPositionCount;
    Positions positions(volume);
    uint32_t hits = 0;
    uint64_t steps_from_seed = 0;
    for (uint32_t i = 0; i < kPositionCount; ++i) {
        const LocationTrace trace = trace_location(volume, positions.in_any_cell());
        hits += trace.step_count == 1;
        steps_from_seed += trace.step_count;
    }
    facts.seed_hit_rate = static_cast<double>(hits) / kPositionCount;
    facts.steps_from_seed = static_cast<double>(steps_from_seed) / kPositionCount;

    std::vector<uint32_t> steps;
    for (uint32_t i = 0; i < kPositionCount; ++i) {
        const LocationTrace trace = trace_location(volume, positions.around());
        steps.push_back(trace.step_count);
        facts.fallback_count += trace.is_fallback;
    }
    std::ranges::sort(steps);
    facts.median_steps = steps[kPositionCount / 2];
    facts.p99_steps = steps[kPositionCount * 99 / 100];
    facts.most_steps = steps.back();
    return facts;
}

}  // namespace tetralight::cli
