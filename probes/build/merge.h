// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_group.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

struct MergeSettings {
    /// Probes nearer to each other than this share of the local spacing become one. The spacing at
    /// a probe is its distance to its seventh nearest neighbor (of fewer than eight probes to the
    /// one in the middle), so that probes far away have no say in it, and 10 m at most: 1e-4 never
    /// welds probes more than 1 mm apart. Whatever this is, probes are welded that floats could not
    /// tell apart. Precondition: not negative.
    double weld_tolerance = 1e-4;

    bool operator==(const MergeSettings&) const = default;
};

/// All groups as one set of probes, in canonical order: along a Hilbert curve through the bounding
/// cube. The same for every order of the groups.
struct MergedProbes {
    /// World space, distinct.
    std::vector<glm::dvec3> positions;
    /// Sorted.
    std::vector<std::string> group_names;
    /// Every probe of every group, sorted by group, then index. Those that `leave_out` took away
    /// have no probe.
    std::vector<ProbeSource> sources;
    /// No two positions are nearer to each other than this, metres.
    double weld_radius = 0.0;
    /// One a group: whether it asked for dering.
    std::vector<bool> group_dering;
    /// One a group: whether its probes are part of a lattice. They were moved exactly onto it then.
    std::vector<bool> group_is_lattice;
    /// The longest of these moves, metres: a few float steps of the group's largest coordinate, and
    /// never more than a thousandth of the distance between neighbors in the lattice.
    double largest_snap = 0.0;

    /// Names of the groups that are lattices.
    [[nodiscard]] std::vector<std::string> lattice_group_names() const;

    /// Probes that were welded to another one.
    [[nodiscard]] size_t welded_count() const;
};

/// What `tetrahedralize` may take for flat: half the weld radius, so that positions that stand
/// apart never fall together in a plane.
[[nodiscard]] double flatness(const MergedProbes& probes);

/// Joins groups into one set. Two probes are welded when they are nearer to each other than the
/// tolerance of both, so that a probe of a sparse part swallows none of a dense one. Clusters are
/// closed transitively; the lexicographically smallest position stands for its cluster.
///
/// Returns invalid_argument, with the field `groups[1].positions[7]`, if a group has no name, a
/// name with control characters (a line break) or bytes that are not UTF-8, or the name of another
/// group, or if a position is not finite or beyond 1e18.
[[nodiscard]] Result<MergedProbes> merge(std::span<const ProbeGroup> groups,
                                         const MergeSettings& settings = {});

}  // namespace tetralight
