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
    /// Probes nearer to each other than this fraction of the local spacing become one. The spacing
    /// at a probe is the distance to its seventh nearest neighbor (with fewer than eight probes the
    /// median one), so that probes far away do not affect it, and 10 m at most: 1e-4 never welds
    /// probes more than 1 mm apart. Probes that floats cannot distinguish are always welded.
    /// Precondition: not negative.
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
    /// Every probe of every group, sorted by group, then index. Those that `remove_probes`
    /// removed have no probe.
    std::vector<ProbeSource> sources;
    /// No two positions are nearer to each other than this, metres.
    double weld_radius = 0.0;
    /// One a group: true if its light is to be deringed.
    std::vector<bool> group_dering;
    /// One a group: the rendering layers of its probes. A welded probe is on those of all its
    /// sources.
    std::vector<uint32_t> group_rendering_layers;
    /// One a group: `ProbeGroup::empty_warning`.
    std::vector<std::string> group_empty_warnings;
    /// One a group: true if its probes are part of a lattice. They were moved exactly onto it.
    std::vector<bool> group_is_lattice;
    /// The longest of these moves, metres: a few float steps of the group's largest coordinate, and
    /// never more than a thousandth of the distance between neighbors in the lattice.
    double largest_snap = 0.0;

    /// Names of the groups that are lattices.
    [[nodiscard]] std::vector<std::string> lattice_group_names() const;

    /// Probes that were welded to another one.
    [[nodiscard]] size_t welded_count() const;
};

/// Distance from a plane below which `tetrahedralize` treats merged probes as flat: half the weld
/// radius, so that distinct positions stay distinct in the plane.
[[nodiscard]] double flat_tolerance(const MergedProbes& probes);

/// Joins groups into one set. Two probes are welded if they are nearer to each other than the
/// tolerances of both, so that probes of a sparse part do not absorb those of a dense one. Clusters
/// are closed transitively; the lexicographically smallest position represents its cluster.
///
/// Returns invalid_argument, with the field `groups[1].positions[7]`, if a group has no name, a
/// name with control characters (a line break) or bytes that are not UTF-8, the name of another
/// group or no rendering layer, or if a position is not finite or beyond 1e18.
[[nodiscard]] Result<MergedProbes> merge(std::span<const ProbeGroup> groups,
                                         const MergeSettings& settings = {});

}  // namespace tetralight
