// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/refine_cells.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

/// The refined cells hold this fraction of all errors at most; the others may be noise. Cells that
/// cannot be refined do not count: they would end the refinement of all others.
constexpr double kRefinedFraction = 0.9;
/// Minimum distance between new probes, as a fraction of the distance to their cell's corners.
constexpr double kDistanceFraction = 0.5;

/// The errors of one cell.
struct CellError {
    uint32_t cell = 0;
    double sum = 0.0;
    uint32_t worst = kNoIndex;  ///< sensor, as an index into the errors
};

std::vector<CellError> errors_by_cell(const RefineInput& input) {
    std::vector<CellError> cells(input.volume.cells.size());
    for (uint32_t i = 0; i < input.errors.size(); ++i) {
        const SensorError& error = input.errors[i];
        if (error.cell == kNoIndex) continue;
        CellError& cell = cells[error.cell];
        cell.cell = error.cell;
        cell.sum += double{error.square};
        if (cell.worst == kNoIndex || error.square > input.errors[cell.worst].square) {
            cell.worst = i;
        }
    }
    std::erase_if(cells, [](const CellError& cell) { return !(cell.sum > 0.0); });
    std::ranges::stable_sort(cells, std::greater{}, &CellError::sum);
    return cells;
}

class Refiner {
  public:
    Refiner(const RefineInput& input, const RefineRule& rule) : input_(input), rule_(rule) {}

    Refinement run() {
        const std::vector<CellError> cells = errors_by_cell(input_);
        double all = 0.0, done = 0.0;
        for (const CellError& cell : cells) all += cell.sum;
        size_t count = 0;
        for (const CellError& cell : cells) {
            if (count == rule_.max_cell_count || done > kRefinedFraction * all) break;
            if (!refine(cell)) continue;
            done += cell.sum;
            ++count;
        }
        return std::move(result_);
    }

  private:
    /// Returns true if a probe was added.
    bool refine(const CellError& cell) {
        const SensorError& error = input_.errors[cell.worst];
        const uint32_t sensor = input_.sensors[cell.worst];
        const bool is_leak =
            error.hidden_probe != kNoIndex && error.visible_square < 0.5f * error.square;
        if (is_leak && add_pair(cell, sensor, error.hidden_probe)) return true;
        if (!rule_.may_become_probe(sensor) || !is_apart(cell, input_.pool.position(sensor))) {
            return false;
        }
        result_.sensors.push_back(sensor);
        taken_.push_back(input_.pool.position(sensor));
        return true;
    }

    bool add_pair(const CellError& cell, uint32_t sensor, uint32_t hidden) {
        const glm::dvec3& from = input_.pool.position(sensor);
        const glm::dvec3& to = input_.volume.exact_positions[hidden];
        bool is_any = false;
        for (const glm::dvec3& position :
             pair_at_wall(input_.traced, from, to, rule_.clearance, glm::distance(from, to))) {
            if (!is_apart(cell, position) || !is_new(position)) continue;
            if (!rule_.is_allowed(position)) continue;
            result_.positions.push_back(position);
            taken_.push_back(position);
            is_any = true;
        }
        return is_any;
    }

    /// True if a position is not too close to a corner of the cell or to a new probe.
    [[nodiscard]] bool is_apart(const CellError& cell, const glm::dvec3& position) const {
        double room = std::numeric_limits<double>::infinity();
        for (const uint32_t probe : input_.volume.cells[cell.cell].vertices) {
            if (probe == kNoIndex) continue;
            room = std::min(room, glm::distance(position, input_.volume.exact_positions[probe]));
        }
        if (!(room > rule_.clearance)) return false;
        // The two probes of a pair are closer to each other than to other probes.
        const double least = std::min(kDistanceFraction * room, 1.5 * rule_.clearance);
        return std::ranges::none_of(taken_, [&](const glm::dvec3& other) {
            return glm::distance(position, other) < least;
        });
    }

    /// True if no probe is within the clearance. The far side of a wall is outside of the cell.
    [[nodiscard]] bool is_new(const glm::dvec3& position) const {
        return std::ranges::none_of(input_.volume.exact_positions, [&](const glm::dvec3& probe) {
            return glm::distance(position, probe) <= rule_.clearance;
        });
    }

    const RefineInput& input_;
    const RefineRule& rule_;
    Refinement result_;
    std::vector<glm::dvec3> taken_;
};

}  // namespace

std::vector<glm::dvec3> pair_at_wall(const TraceScene& traced, const glm::dvec3& from,
                                     const glm::dvec3& to, double clearance, double thickness) {
    const glm::vec3 start = traced.render_from_world(from);
    const glm::vec3 way = traced.render_from_world(to) - start;
    const float length = glm::length(way);
    if (!(length > 0.0f)) return {};
    const glm::vec3 direction = way / length;
    const auto front = traced.intersect_side({start, direction, length});
    if (!front) return {};
    const auto off = static_cast<float>(clearance);
    const glm::vec3 hit = start + front->distance * direction;
    const glm::vec3 inwards = -front->normal;
    std::vector<glm::dvec3> pair{traced.world_from_render(hit - off * inwards)};
    const glm::vec3 behind = traced.ray_origin(*front, hit, inwards);
    const auto back = traced.intersect_side({behind, inwards});
    if (!back || (!back->is_from_behind && back->distance > 2.0f * off)) {
        pair.push_back(traced.world_from_render(hit + off * inwards));  // a sheet
    } else if (back->is_from_behind && double{back->distance} <= thickness) {
        pair.push_back(traced.world_from_render(behind + (back->distance + off) * inwards));
    }
    return pair;
}

Refinement refine_cells(const RefineInput& input, const RefineRule& rule) {
    TETRALIGHT_ASSERT(input.errors.size() == input.sensors.size(), "one error for each sensor");
    return Refiner(input, rule).run();
}

}  // namespace tetralight
