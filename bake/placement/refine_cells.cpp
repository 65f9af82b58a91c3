// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/refine_cells.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

/// The refined cells hold this fraction of all costs at most; the others may be noise. Cells that
/// cannot be refined do not count: they would end the refinement of all others.
constexpr double kRefinedFraction = 0.9;
/// Sensors of a cell that are tried.
constexpr size_t kSensorTries = 8;
/// Minimum distance between new probes, as a fraction of the distance to their cell's corners.
constexpr double kDistanceFraction = 0.5;

/// The sensors of one cell, as indices into the errors.
struct CellCost {
    uint32_t cell = 0;
    double sum = 0.0;
    std::vector<uint32_t> sensors;
};

std::vector<CellCost> costs_by_cell(const RefineInput& input) {
    std::map<uint32_t, CellCost> by_cell;
    for (uint32_t i = 0; i < input.errors.size(); ++i) {
        const SensorError& error = input.errors[i];
        if (error.cell == kNoIndex || !(error.cost() > 0.0)) continue;
        CellCost& cost = by_cell[error.cell];
        cost.cell = error.cell;
        cost.sum += error.cost();
        cost.sensors.push_back(i);
    }
    std::vector<CellCost> costs;
    for (auto& [cell, cost] : by_cell) {
        std::ranges::stable_sort(cost.sensors, std::greater{},
                                 [&](uint32_t i) { return input.errors[i].cost(); });
        costs.push_back(std::move(cost));
    }
    std::ranges::stable_sort(costs, std::greater{}, &CellCost::sum);
    return costs;
}

class Refiner {
  public:
    Refiner(const RefineInput& input, const RefineRule& rule) : input_(input), rule_(rule) {}

    std::vector<uint32_t> run() {
        const std::vector<CellCost> costs = costs_by_cell(input_);
        double all = 0.0, done = 0.0;
        for (const CellCost& cost : costs) all += cost.sum;
        for (const CellCost& cost : costs) {
            if (found_.size() == rule_.max_cell_count || done > kRefinedFraction * all) break;
            if (refine(cost)) done += cost.sum;
        }
        return std::move(found_);
    }

  private:
    /// Returns true if a probe was added.
    bool refine(const CellCost& cost) {
        for (size_t k = 0; k < std::min(cost.sensors.size(), kSensorTries); ++k) {
            const uint32_t sensor = input_.sensors[cost.sensors[k]];
            if (!is_apart(cost.cell, input_.pool.position(sensor))) continue;
            if (!rule_.may_become_probe(sensor)) continue;
            found_.push_back(sensor);
            return true;
        }
        return false;
    }

    /// True if a position is not too close to a corner of the cell or to a new probe.
    [[nodiscard]] bool is_apart(uint32_t cell, const glm::dvec3& position) const {
        double room = std::numeric_limits<double>::infinity();
        for (const uint32_t probe : input_.volume.cells[cell].vertices) {
            if (probe == kNoIndex) continue;
            room = std::min(room, glm::distance(position, input_.volume.exact_positions[probe]));
        }
        if (!(room > rule_.clearance)) return false;
        return std::ranges::none_of(found_, [&](uint32_t other) {
            return glm::distance(position, input_.pool.position(other)) < kDistanceFraction * room;
        });
    }

    const RefineInput& input_;
    const RefineRule& rule_;
    std::vector<uint32_t> found_;
};

}  // namespace

std::vector<uint32_t> refine_cells(const RefineInput& input, const RefineRule& rule) {
    TETRALIGHT_ASSERT(input.errors.size() == input.sensors.size(), "one error for each sensor");
    return Refiner(input, rule).run();
}

}  // namespace tetralight
