// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

struct LeakSettings {
    /// Random places of free space to compare at, at least 1.
    uint32_t place_count = 1000;
    /// Samples of the traced light at each place, at least 2.
    uint32_t sample_count = 256;
    /// Least distance of a place from all surfaces, metres.
    float clearance = 0.05f;
    uint64_t seed = 0;
    /// Number of threads; 0 = all.
    uint32_t thread_count = 0;
};

/// The light at one place: mean irradiance over all directions, as luminance, in the unit of the
/// scene's lights. `by_rays` is the answer from those corners of the cell alone that a true ray
/// reaches; if none is, it is the traced light. So the answer is split into
///
///     answer = traced + through walls − missing ± rest
struct LeakPlace {
    glm::dvec3 position{0.0};
    bool is_unseen = false;
    double answer = 0.0;  ///< with weights that know walls
    double plain = 0.0;   ///< with weights that know no walls
    double by_rays = 0.0;
    double traced = 0.0;
    /// What the corners that no ray reaches add to the answer, which is the sum of their weights
    /// times the difference of their light to `by_rays`: negative if they darken it.
    double hidden = 0.0;
    /// Half the difference of the two independent estimates whose mean is `traced`.
    double noise = 0.0;

    [[nodiscard]] double through_walls() const { return std::max(hidden, 0.0); }

    /// Light of corners that rays reach, and that the answer lacks.
    [[nodiscard]] double missing() const {
        return std::max(by_rays + through_walls() - answer, 0.0);
    }

    /// What remains: distance between the probes, and noise.
    [[nodiscard]] double rest() const {
        return std::abs(answer - through_walls() + missing() - traced);
    }

    [[nodiscard]] double plain_through_walls() const { return std::max(plain - by_rays, 0.0); }

    [[nodiscard]] double plain_missing() const { return std::max(by_rays - plain, 0.0); }

    bool operator==(const LeakPlace&) const = default;
};

/// One part of the answers, divided by the mean traced light of all places.
struct LeakPart {
    double mean = 0.0;
    double p95 = 0.0;  ///< 95 % of the places have at most this

    bool operator==(const LeakPart&) const = default;
};

struct LeakReport {
    /// As drawn.
    std::vector<LeakPlace> places;
    /// Places that see no corner of their cell.
    uint64_t unseen_count = 0;
    /// Mean traced light of the places.
    double mean_light = 0.0;
    LeakPart through_walls;
    LeakPart missing;
    /// The same if weights knew no walls.
    LeakPart plain_through_walls;
    LeakPart plain_missing;
    LeakPart rest;
    /// What noise of the traced light adds to `rest` in the mean.
    double noise = 0.0;

    /// Indices of up to `count` places with the most light through walls, the worst first; none
    /// without such light.
    [[nodiscard]] std::vector<uint32_t> worst_places(size_t count = 8) const;

    bool operator==(const LeakReport&) const = default;
};

/// Compares a baked volume's answers with light that is traced at random free places
/// (pipeline/free_places.h), by the bake settings that the volume's metadata records. A volume with
/// layers is compared as it was baked, with all weights 1. Two runs give the same report for any
/// number of threads.
///
/// Returns invalid_argument if a setting is out of range, the volume holds no light or was relit,
/// or no light arrives at any place; not_found (field "places") if no place is free; and the errors
/// of `recorded_settings`, `TraceScene::make_static` and `bake_probes`.
[[nodiscard]] Result<LeakReport> check_leaks(const Scene& scene, const ProbeVolumeView& volume,
                                             const LeakSettings& settings,
                                             const BakeCallback& callback = {});

}  // namespace tetralight
