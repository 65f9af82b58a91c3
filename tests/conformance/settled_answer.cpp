// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/settled_answer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <optional>
#include <vector>

#include <tetralight/probes/detail/cell_corners.h>
#include <tetralight/probes/is_finite.h>
#include "tests/support/location_reference.h"

namespace tetralight::conformance {
namespace {

/// Cells in which rounding changes weights by more are slivers, which contain no position.
constexpr long double kSliver = 1e-5L;

/// Cells that contain a position but for this have it on a common face.
constexpr long double kOnFace = 1e-9L;

class SettledCheck {
  public:
    SettledCheck(const ProbeVolumeView& volume, const VectorOptions& options,
                 const CellLocation& location, float largest_light)
        : volume_(volume),
          options_(options),
          location_(location),
          largest_light_(largest_light),
          light_(interpolate(volume, location, options.receiver)),
          weights_(weights_by_probe(location)) {}

    [[nodiscard]] bool run(const glm::vec3& position) const {
        const test::LocationReference reference(volume_);
        bool is_found = false;
        for (uint32_t cell = 0; cell < volume_.cells.size(); ++cell) {
            const auto weights = reference.weights(position, cell);
            if (!weights || weights->rounding > kSliver || weights->behind > kOnFace) continue;
            if (weights->least() < -(kOnFace + weights->rounding)) continue;
            is_found |= cell == location_.cell;
            if (!gives_the_same(location_of(cell, *weights))) return false;
        }
        return is_found && is_stable();
    }

    /// Whether the last digit of a weight changes nothing.
    [[nodiscard]] bool is_stable() const {
        for (int i = 0; i < 4; ++i) {
            CellLocation changed = location_;
            changed.weights[i] *= 1.0f + 0x1p-23f;
            if (!gives_the_same(changed)) return false;
        }
        return true;
    }

  private:
    static CellLocation location_of(uint32_t cell, const test::ReferenceWeights& weights) {
        CellLocation location{cell, 0.0f, glm::vec4(0.0f)};
        long double sum = 0.0L;
        for (const long double w : weights.weights) sum += std::max(w, 0.0L);
        for (int i = 0; i < 4; ++i) {
            const long double w = std::max(weights.weights[static_cast<size_t>(i)], 0.0L);
            location.weights[i] = static_cast<float>(w / sum);
        }
        return location;
    }

    [[nodiscard]] std::map<uint32_t, float> weights_by_probe(const CellLocation& location) const {
        const CellLocation visible = visible_location(volume_, location, options_.receiver);
        std::map<uint32_t, float> weights;
        const auto probes = probes_of(volume_, location);
        for (size_t i = 0; i < probes.size(); ++i) {
            weights[probes[i]] = visible.weights[static_cast<int>(i)];
        }
        return weights;
    }

    [[nodiscard]] bool gives_the_same(const CellLocation& other) const {
        auto difference = weights_by_probe(other);
        for (const auto& [probe, weight] : weights_) difference[probe] -= weight;
        const auto is_small = [](const auto& entry) {
            return std::abs(entry.second) <= kSettledWeight;
        };
        if (!std::ranges::all_of(difference, is_small)) return false;
        const InterpolatedProbe light = interpolate(volume_, other, options_.receiver);
        for (size_t i = 0; i < light.irradiance.coefficients.size(); ++i) {
            if (!is_near(light.irradiance.coefficients[i], light_.irradiance.coefficients[i])) {
                return false;
            }
        }
        const auto gives_the_same_to = [&](const glm::vec3& normal) {
            return is_near(evaluate_irradiance(light.irradiance, normal),
                           evaluate_irradiance(light_.irradiance, normal));
        };
        const glm::vec4 lit = glm::abs(light.occlusion - light_.occlusion);
        return std::ranges::all_of(vector_normals(), gives_the_same_to) &&
               std::max({lit.x, lit.y, lit.z, lit.w}) <= kSettledWeight;
    }

    [[nodiscard]] bool is_near(const glm::vec3& a, const glm::vec3& b) const {
        const glm::vec3 apart = glm::abs(a - b);
        return std::max({apart.x, apart.y, apart.z}) <= kSettledLight * largest_light_;
    }

    const ProbeVolumeView& volume_;
    const VectorOptions& options_;
    CellLocation location_;
    float largest_light_;
    InterpolatedProbe light_;
    std::map<uint32_t, float> weights_;
};

/// The reference takes positions as they are.
bool is_within_reach(const ProbeVolumeView& volume, const glm::vec3& position) {
    const glm::dvec3 local = glm::dvec3(position) - volume.info.world_origin;
    return !detail::within_reach(volume.info, detail::foot_on_probes(volume, local)).is_moved;
}

}  // namespace

bool is_settled(const ProbeVolumeView& volume, const VectorOptions& options,
                const VectorAnswer& answer, float largest_light) {
    if (!is_finite(answer.at.position) || volume.cells.empty()) return true;
    const SettledCheck check(volume, options, answer.location, largest_light);
    glm::vec3 position = answer.at.position;
    if (options.normal_offset) {
        position = push_off_surface(volume, position, answer.at.normal, locate(volume, position),
                                    *options.normal_offset);
    }
    const bool is_referenced =
        options.outside.policy == OutsidePolicy::Extrapolate && is_within_reach(volume, position);
    return is_referenced ? check.run(position) : check.is_stable();
}

}  // namespace tetralight::conformance
