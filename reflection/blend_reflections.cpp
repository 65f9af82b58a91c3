// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <tuple>

#include <tetralight/reflection/detail/probe_box.h>
#include <tetralight/reflection/sample_reflections.h>

namespace tetralight {
namespace {

/// A probe that counts at a position.
struct Candidate {
    int32_t importance = 0;
    double volume = 0.0;
    uint32_t probe = 0;
    float influence = 0.0f;

    /// Whether this one covers the other.
    [[nodiscard]] bool is_before(const Candidate& other) const noexcept {
        if (importance != other.importance) return importance > other.importance;
        return std::tie(volume, probe) < std::tie(other.volume, other.probe);
    }
};

/// The first probes that count, in the order in which they cover each other.
struct Candidates {
    static constexpr size_t kRoom = 32;

    std::array<Candidate, kRoom> all;
    size_t count = 0;

    /// Keeps the first `kRoom`.
    void insert(const Candidate& candidate) noexcept {
        if (count == kRoom && !candidate.is_before(all.back())) return;
        size_t place = count < kRoom ? count++ : kRoom - 1;
        for (; place > 0 && candidate.is_before(all[place - 1]); --place) {
            all[place] = all[place - 1];
        }
        all[place] = candidate;
    }
};

/// The four largest weights, in descending order.
struct LargestWeights {
    std::array<uint32_t, 4> probes{};
    std::array<float, 4> weights{};

    void insert(uint32_t probe, float weight) noexcept {
        if (!(weight > weights.back())) return;
        size_t place = weights.size() - 1;
        for (; place > 0 && weight > weights[place - 1]; --place) {
            weights[place] = weights[place - 1];
            probes[place] = probes[place - 1];
        }
        weights[place] = weight;
        probes[place] = probe;
    }
};

/// Of the box, without the influence.
Candidate candidate_of(const ReflectionsView& reflections, uint32_t i) noexcept {
    const ReflectionProbe& probe = reflections.probes[i];
    const glm::dvec3 half(probe.half_size);
    const double product = half.x * half.y * half.z;
    const double volume = product >= 0.0 ? product : std::numeric_limits<double>::infinity();
    return {probe.importance, volume, i, 0.0f};
}

/// The candidates that come after one of them; the first ones without.
Candidates candidates_after(const ReflectionsView& reflections, const glm::dvec3& position,
                            const Candidate* last) noexcept {
    Candidates found;
    const auto count = static_cast<uint32_t>(reflections.probes.size());
    for (uint32_t i = 0; i < count; ++i) {
        const float influence = reflection_influence(reflections.probes[i], position);
        if (!(influence > 0.0f)) continue;
        Candidate candidate = candidate_of(reflections, i);
        candidate.influence = influence;
        if (!last || last->is_before(candidate)) found.insert(candidate);
    }
    return found;
}

/// The weights of probes, each of which takes what the earlier ones left, up to its influence.
LargestWeights composited(const ReflectionsView& reflections, const glm::dvec3& position) noexcept {
    LargestWeights largest;
    float uncovered = 1.0f;
    Candidates found = candidates_after(reflections, position, nullptr);
    while (found.count > 0) {
        for (size_t i = 0; i < found.count; ++i) {
            const Candidate& candidate = found.all[i];
            const float weight = std::min(candidate.influence, uncovered);
            largest.insert(candidate.probe, weight);
            uncovered -= weight;
        }
        if (found.count < Candidates::kRoom || uncovered == 0.0f) break;
        const Candidate last = found.all.back();
        found = candidates_after(reflections, position, &last);
    }
    return largest;
}

/// The probe whose box is the nearest; all of the weight.
ReflectionBlend nearest_probe(const ReflectionsView& reflections,
                              const glm::dvec3& position) noexcept {
    ReflectionBlend blend;
    double nearest = std::numeric_limits<double>::infinity();
    const auto count = static_cast<uint32_t>(reflections.probes.size());
    for (uint32_t i = 0; i < count; ++i) {
        const ReflectionProbe& probe = reflections.probes[i];
        const double distance =
            detail::distance_to_box(probe, detail::place_in_box(probe, position));
        if (!(distance < nearest)) continue;
        nearest = distance;
        blend.probes[0] = i;
        blend.weights[0] = 1.0f;
    }
    return blend;
}

}  // namespace

float reflection_influence(const ReflectionProbe& probe, const glm::dvec3& position) noexcept {
    if (probe.is_everywhere()) return 1.0f;
    const double distance = detail::distance_to_box(probe, detail::place_in_box(probe, position));
    if (distance == 0.0) return 1.0f;
    if (!(distance < probe.blend_distance)) return 0.0f;
    const double t = 1.0 - distance / probe.blend_distance;
    return static_cast<float>(t * t * (3.0 - 2.0 * t));
}

ReflectionBlend blend_reflections(const ReflectionsView& reflections,
                                  const glm::dvec3& position) noexcept {
    const LargestWeights largest = composited(reflections, position);
    const auto& w = largest.weights;
    if (!(w[0] > 0.0f)) return nearest_probe(reflections, position);
    ReflectionBlend blend;
    const float least = w[3];
    const float sum = (w[0] - least) + (w[1] - least) + (w[2] - least);
    for (size_t i = 0; i < ReflectionBlend::kMaxProbes; ++i) {
        const float share = sum > 0.0f ? (w[i] - least) / sum : 1.0f / 3.0f;
        if (share > 0.0f) {
            blend.probes[i] = largest.probes[i];
            blend.weights[i] = share;
        }
    }
    return blend;
}

std::vector<uint32_t> reflection_order(const ReflectionsView& reflections) {
    std::vector<Candidate> candidates;
    const auto count = static_cast<uint32_t>(reflections.probes.size());
    for (uint32_t i = 0; i < count; ++i) candidates.push_back(candidate_of(reflections, i));
    std::ranges::sort(candidates,
                      [](const Candidate& a, const Candidate& b) { return a.is_before(b); });
    std::vector<uint32_t> order;
    for (const Candidate& candidate : candidates) order.push_back(candidate.probe);
    return order;
}

}  // namespace tetralight
