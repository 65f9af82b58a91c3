// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "probes/probe_group.h"
#include "probes/probe_volume.h"

namespace tetralight {

struct MergeSettings {
    /// Positions nearer to each other than this share of the set's bounding-box diagonal become one
    /// probe. The default is a few steps of the floats that queries use: nearer positions could not
    /// be told apart.
    double weld_tolerance = 4e-7;

    bool operator==(const MergeSettings&) const = default;
};

/// All groups as one set of probes, in canonical order: along a Hilbert curve through the bounding
/// cube. The same for every order of the groups.
struct MergedProbes {
    /// World space, distinct.
    std::vector<glm::dvec3> positions;
    /// Sorted.
    std::vector<std::string> group_names;
    /// Every probe of every group, sorted by group, then index.
    std::vector<ProbeSource> sources;
    /// Positions nearer to each other than this were welded, metres.
    double weld_radius = 0.0;
    /// One a group: whether it asked for dering.
    std::vector<bool> group_dering;

    /// Probes that were welded to another one.
    [[nodiscard]] size_t welded_count() const { return sources.size() - positions.size(); }
};

/// What `tetrahedralize` may take for flat: half the weld radius, so that positions that stand
/// apart never fall together in a plane.
[[nodiscard]] double flatness(const MergedProbes& probes);

/// Joins groups into one set. Clusters of near positions are closed transitively; the
/// lexicographically smallest position stands for its cluster.
///
/// Errors: a group without a name, with a line break in it or with the name of another; a position
/// that is not finite or beyond 1e18 (they name the group and the index).
[[nodiscard]] Result<MergedProbes> merge(std::span<const ProbeGroup> groups,
                                         const MergeSettings& settings = {});

}  // namespace tetralight
