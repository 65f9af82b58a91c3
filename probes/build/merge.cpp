// SPDX-License-Identifier: Apache-2.0
#include "probes/build/merge.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/text.h"
#include "probes/build/detail/hilbert_order.h"

namespace tetralight {
namespace {

constexpr double kFarthest = 1e18;

/// Positions nearer to each other than this are one: squares of such lengths leave the floats.
constexpr double kNearest = 1e-15;

bool is_finite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

Error position_error(const ProbeGroup& group, size_t index, const char* what, glm::dvec3 p) {
    return {text("group \"", group.name, "\": probe ", index, ": position ", what, " (", p.x, ", ",
                 p.y, ", ", p.z, ")")};
}

Status check_name(const ProbeGroup& group, const ProbeGroup* previous) {
    if (group.name.empty()) return Error{"a probe group has no name"};
    if (group.name.find('\n') != std::string::npos) {
        return Error{text("group \"", group.name, "\": the name holds a line break")};
    }
    if (previous != nullptr && previous->name == group.name) {
        return Error{text("group \"", group.name, "\": there are two groups of this name")};
    }
    return Ok{};
}

Result<std::vector<glm::dvec3>> world_positions(const ProbeGroup& group) {
    std::vector<glm::dvec3> positions;
    for (size_t i = 0; i < group.positions.size(); ++i) {
        const glm::dvec3 p(group.world_from_group * glm::dvec4(group.positions[i], 1.0));
        if (!is_finite(group.positions[i])) {
            return position_error(group, i, "is not finite", group.positions[i]);
        }
        if (!is_finite(p) || glm::length(p) > kFarthest) {
            return position_error(group, i, "in the world is beyond 1e18", p);
        }
        positions.push_back(p + 0.0);  // -0 becomes 0: equal positions have equal bits
    }
    return positions;
}

bool is_before(const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Joins positions within a radius of each other into clusters, by a hash grid. Its cells are wide
/// against the radius, so that most positions are near no other cell.
class Welder {
  public:
    Welder(std::span<const glm::dvec3> positions, double radius)
        : positions_(positions),
          radius_(radius),
          cell_size_(kRadiiPerCell * radius),
          parents_(positions.size()),
          next_in_cell_(positions.size(), kNoIndex) {
        std::iota(parents_.begin(), parents_.end(), 0u);
        first_in_cell_.reserve(positions.size());
    }

    /// For each position the one that stands for its cluster.
    std::vector<uint32_t> run() {
        for (uint32_t i = 0; i < positions_.size(); ++i) {
            if (join_with_equal(i)) continue;
            join_near(i);
            const auto [cell, is_new] = first_in_cell_.try_emplace(cell_of(positions_[i]), i);
            if (!is_new) next_in_cell_[i] = std::exchange(cell->second, i);
        }
        std::vector<uint32_t> representatives(positions_.size());
        for (uint32_t i = 0; i < positions_.size(); ++i) representatives[i] = root(i);
        return representatives;
    }

  private:
    static constexpr double kRadiiPerCell = 64.0;

    struct CellHash {
        size_t operator()(const glm::dvec3& cell) const {
            uint64_t hash = 0;
            for (int axis = 0; axis < 3; ++axis) {
                hash = (hash ^ std::bit_cast<uint64_t>(cell[axis])) * 0x9e3779b97f4a7c15u;
                hash ^= hash >> 32;
            }
            return hash;
        }
    };

    /// Without a radius every position is a cell of its own.
    [[nodiscard]] glm::dvec3 cell_of(const glm::dvec3& position) const {
        return cell_size_ > 0 ? glm::floor(position / cell_size_) + 0.0 : position;
    }

    /// An equal position joins its twin and need not be found again: thousands of them cost
    /// nothing.
    bool join_with_equal(uint32_t i) {
        const auto found = first_in_cell_.find(cell_of(positions_[i]));
        if (found == first_in_cell_.end()) return false;
        for (uint32_t j = found->second; j != kNoIndex; j = next_in_cell_[j]) {
            if (positions_[i] != positions_[j]) continue;
            join(i, j);
            return true;
        }
        return false;
    }

    void join_near(uint32_t i) {
        const glm::dvec3 low = cell_of(positions_[i] - radius_);
        const glm::dvec3 high = cell_of(positions_[i] + radius_);
        for (const double x : {low.x, high.x}) {
            for (const double y : {low.y, high.y}) {
                for (const double z : {low.z, high.z}) {
                    join_with_cell(i, {x, y, z});
                    if (low.z == high.z) break;
                }
                if (low.y == high.y) break;
            }
            if (low.x == high.x) break;
        }
    }

    void join_with_cell(uint32_t i, const glm::dvec3& cell) {
        const auto found = first_in_cell_.find(cell);
        if (found == first_in_cell_.end()) return;
        for (uint32_t j = found->second; j != kNoIndex; j = next_in_cell_[j]) {
            if (glm::distance(positions_[i], positions_[j]) <= radius_) join(i, j);
        }
    }

    /// The root of a cluster is always its lexicographically smallest position.
    void join(uint32_t a, uint32_t b) {
        a = root(a);
        b = root(b);
        if (is_before(positions_[b], positions_[a])) std::swap(a, b);
        parents_[b] = a;
    }

    uint32_t root(uint32_t i) {
        while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
        return i;
    }

    std::span<const glm::dvec3> positions_;
    double radius_;
    double cell_size_;
    std::vector<uint32_t> parents_;
    std::vector<uint32_t> next_in_cell_;
    std::unordered_map<glm::dvec3, uint32_t, CellHash> first_in_cell_;
};

double weld_radius(std::span<const glm::dvec3> positions, const MergeSettings& settings) {
    glm::dvec3 low(kFarthest);
    glm::dvec3 high(-kFarthest);
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    if (positions.empty()) return 0.0;
    return std::max(kNearest, settings.weld_tolerance * glm::distance(low, high));
}

/// Puts the representatives in canonical order and points every source at its probe.
void weld(std::span<const glm::dvec3> positions, const MergeSettings& settings,
          MergedProbes& merged) {
    merged.weld_radius = weld_radius(positions, settings);
    const auto representatives = Welder(positions, merged.weld_radius).run();
    std::vector<glm::dvec3> kept;
    std::vector<uint32_t> kept_index(positions.size(), kNoIndex);
    for (uint32_t i = 0; i < positions.size(); ++i) {
        if (representatives[i] != i) continue;
        kept_index[i] = static_cast<uint32_t>(kept.size());
        kept.push_back(positions[i]);
    }
    const std::vector<uint32_t> order = detail::hilbert_order(kept);
    std::vector<uint32_t> place(kept.size());
    for (uint32_t i = 0; i < order.size(); ++i) {
        place[order[i]] = i;
        merged.positions.push_back(kept[order[i]]);
    }
    for (uint32_t i = 0; i < positions.size(); ++i) {
        merged.sources[i].probe = place[kept_index[representatives[i]]];
    }
}

}  // namespace

double flatness(const MergedProbes& probes) {
    return 0.5 * probes.weld_radius;
}

Result<MergedProbes> merge(std::span<const ProbeGroup> groups, const MergeSettings& settings) {
    std::vector<const ProbeGroup*> sorted;
    for (const ProbeGroup& group : groups) sorted.push_back(&group);
    std::ranges::sort(sorted, {},
                      [](const ProbeGroup* group) { return std::string_view(group->name); });

    MergedProbes merged;
    std::vector<glm::dvec3> positions;
    for (uint32_t g = 0; g < sorted.size(); ++g) {
        const ProbeGroup& group = *sorted[g];
        const auto name = check_name(group, g > 0 ? sorted[g - 1] : nullptr);
        if (!name) return name.error();
        const auto group_positions = world_positions(group);
        if (!group_positions) return group_positions.error();
        merged.group_names.push_back(group.name);
        merged.group_dering.push_back(group.dering);
        for (uint32_t i = 0; i < group_positions->size(); ++i) {
            merged.sources.push_back({g, i, 0});
            positions.push_back((*group_positions)[i]);
        }
    }
    if (positions.size() >= kNoIndex / 8) {
        return Error{text(positions.size(), " probes are more than 32-bit cell indices can name")};
    }
    weld(positions, settings, merged);
    return merged;
}

}  // namespace tetralight
