// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/remove_probes.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/affine_dimension.h>
#include <tetralight/bake/placement/cell_lists.h>
#include <tetralight/base/contract.h>
#include <tetralight/probes/content_hash.h>

namespace tetralight {
namespace {

/// What surrounds one probe.
struct Star {
    std::vector<uint32_t> neighbors;  ///< sorted, by number in the volume
    std::vector<uint32_t> sensors;    ///< in its cells, as indices into the errors
};

Star star_of(uint32_t probe, const ProbeVolume& volume, const Lists& cells, const Lists& sensors) {
    Star star;
    star.neighbors = probes_of_cells(volume, cells[probe]);
    std::erase(star.neighbors, probe);
    for (const uint32_t c : cells[probe]) {
        star.sensors.insert(star.sensors.end(), sensors[c].begin(), sensors[c].end());
    }
    return star;
}

/// The probes that are left in each space.
class ProbesOfSpaces {
  public:
    ProbesOfSpaces(const LightPool& pool, std::span<const uint32_t> probes,
                   std::span<const uint32_t> spaces)
        : spaces_(spaces) {
        for (size_t i = 0; i < probes.size(); ++i) {
            positions_.push_back(pool.position(probes[i]));
            left_[spaces[i]].probes.push_back(static_cast<uint32_t>(i));
        }
        for (auto& [space, left] : left_) left.dimension = dimension(left.probes);
    }

    /// Takes one away, unless the others of its space span less without it.
    bool remove(uint32_t i) {
        Left& left = left_[spaces_[i]];
        std::vector<uint32_t> others = left.probes;
        std::erase(others, i);
        if (dimension(others) < left.dimension) return false;
        left.probes = std::move(others);
        return true;
    }

  private:
    struct Left {
        std::vector<uint32_t> probes;
        int dimension = 0;  ///< what they span, before any removal and after it
    };

    [[nodiscard]] int dimension(const std::vector<uint32_t>& probes) const {
        std::vector<glm::dvec3> positions;
        for (const uint32_t probe : probes) positions.push_back(positions_[probe]);
        return affine_dimension(positions);
    }

    std::span<const uint32_t> spaces_;
    std::vector<glm::dvec3> positions_;
    std::map<uint32_t, Left> left_;
};

}  // namespace

std::vector<uint32_t> ProbeRemover::pass(const RemoveInput& input, const RemoveRule& rule) {
    TETRALIGHT_ASSERT(input.errors.size() == input.sensors.size(), "one error for each sensor");
    TETRALIGHT_ASSERT(input.spaces.size() == input.probes.size(), "one space for each probe");
    const auto& [probes, spaces, volume, sensors, errors, is_protected] = input;
    const Lists cells = cells_of_probes(volume);
    const Lists sensors_in = sensors_of_cells(volume, errors);
    std::vector<Star> stars(probes.size());
    std::vector<Cost> costs(probes.size());
    parallel_for(probes.size(), rule.thread_count, [&](size_t i) {
        const auto probe = static_cast<uint32_t>(i);
        Star& star = stars[i] = star_of(probe, volume, cells, sensors_in);
        const std::vector<uint32_t> neighbors = named(star.neighbors, probes);
        const std::vector<uint32_t> around = named(star.sensors, sensors);
        ContentHash key;
        key.add(view_.pool.version());
        key.add(neighbors);
        key.add(around);
        costs[i].key = key.value();
        const auto known = costs_.find(probes[i]);
        if (known != costs_.end() && known->second.key == key.value()) {
            costs[i] = known->second;
            return;
        }
        for (const uint32_t sensor : star.sensors) {
            costs[i].change -= errors[sensor].cost();
            costs[i].uncovered -= !errors[sensor].is_covered;
        }
        if (neighbors.empty()) return;
        const ProbeVolume without = volume_of(view_.pool, neighbors);
        for (const SensorError& e : sensor_errors(without, neighbors, around, view_, 1)) {
            costs[i].change += e.cost();
            costs[i].uncovered += !e.is_covered;
        }
    });
    for (size_t i = 0; i < probes.size(); ++i) costs_[probes[i]] = costs[i];

    std::vector<uint32_t> queue(probes.size());
    std::iota(queue.begin(), queue.end(), 0u);
    std::ranges::stable_sort(queue, {}, [&](uint32_t i) { return costs[i].change; });
    double sum = sum_of_costs(errors);
    auto uncovered = static_cast<int64_t>(uncovered_count(errors));
    const auto most = static_cast<size_t>(rule.max_fraction * static_cast<double>(probes.size()));
    std::vector<bool> is_gone(probes.size(), false), is_stale(probes.size(), false);
    ProbesOfSpaces left_in(view_.pool, probes, spaces);
    size_t gone = 0;
    for (const uint32_t i : queue) {
        if (gone >= std::max<size_t>(most, 1) || probes.size() - gone <= rule.min_probe_count)
            break;
        if (is_stale[i] || is_protected[probes[i]]) continue;
        if (sum + costs[i].change > rule.max_cost) break;
        const bool is_bared = uncovered + costs[i].uncovered >
                              static_cast<int64_t>(std::min(rule.max_uncovered, errors.size()));
        if (is_bared && costs[i].uncovered > 0) continue;
        if (!left_in.remove(i)) continue;
        sum += costs[i].change;
        uncovered += costs[i].uncovered;
        is_gone[i] = true;
        ++gone;
        for (const uint32_t neighbor : stars[i].neighbors) is_stale[neighbor] = true;
    }
    std::vector<uint32_t> left;
    for (size_t i = 0; i < probes.size(); ++i) {
        if (!is_gone[i]) left.push_back(probes[i]);
    }
    return left;
}

}  // namespace tetralight
