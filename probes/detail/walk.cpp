// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/walk.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include <tetralight/probes/detail/cell_corners.h>
#include <tetralight/probes/detail/hull_cell.h>
#include <tetralight/probes/seed_grid.h>

namespace tetralight::detail {
namespace {

double longest_square(const std::array<glm::dvec3, 4>& corners, int count) {
    double square = 0.0;
    for (int i = 0; i < count; ++i) square = std::max(square, glm::dot(corners[i], corners[i]));
    return square;
}

/// Cells that are searched around the end of a walk that failed: of the first walk, and of the
/// last.
constexpr size_t kCellsNear = 128;
constexpr size_t kMostCellsNear = 1024;

/// If two neighbors send the walk to each other by more than this, it is a cycle, not rounding.
constexpr double kSettleTolerance = 1e-9;

/// The cell, of those considered, that is nearest to containing the position.
struct Best {
    CellLocation location;
    double measure = -std::numeric_limits<double>::infinity();

    void consider(uint32_t cell, const std::optional<CellWeights>& weights) {
        if (!weights || !(weights->inside_measure() > measure)) return;
        measure = weights->inside_measure();
        location = finish(cell, *weights);
    }
};

}  // namespace

Walk::Walk(const ProbeVolumeView& volume, const glm::vec3& position) noexcept : volume_(volume) {
    const glm::dvec3 local = glm::dvec3(position) - volume.info.world_origin;
    position_ = within_reach(volume.info, foot_on_probes(volume, local)).position;
}

uint32_t Walk::start_cell() const noexcept {
    if (!volume_.seed_grid.empty()) {
        const size_t word = find_seed_word(volume_.seed_grid, glm::vec3(position_));
        const uint32_t cell = word < volume_.seed_grid.size() ? volume_.seed_grid[word] : 0u;
        return cell < volume_.cells.size() ? cell : 0u;
    }
    const uint64_t index = volume_.info.seed_cube.index(position_);
    const auto next = std::ranges::lower_bound(volume_.seeds, index, {}, &Seed::hilbert_index);
    const uint32_t cell = next != volume_.seeds.end() ? next->cell
                          : volume_.seeds.empty()     ? 0u
                                                      : volume_.seeds.back().cell;
    return cell < volume_.cells.size() ? cell : 0u;
}

LocationTrace Walk::run(uint32_t start) const noexcept {
    const LocationTrace first = walk_from(start, kCellsNear);
    if (first.location.cell != kNoIndex) return first;
    uint32_t steps = first.step_count;
    const LocationTrace wandering = wander_from(start_cell());
    steps += wandering.step_count;
    if (wandering.location.cell != kNoIndex) return {wandering.location, steps, false};
    const LocationTrace second = walk_from(start_cell(), kMostCellsNear);
    steps += second.step_count;
    if (second.location.cell != kNoIndex) return {second.location, steps, false};
    return {search_all(), steps, true};
}

/// A walk that leaves each cell by any of the faces that the position lies beyond, and so cannot
/// cycle for long (the stochastic walk of Devillers, Pion & Teillaud 2002). One step in eight is by
/// any face: hull cells that fold over each other can send it in a circle.
LocationTrace Walk::wander_from(uint32_t start) const {
    constexpr uint32_t kMostSteps = 2048;
    constexpr uint32_t kStray = 8;
    std::minstd_rand random;  // the same numbers for each position
    uint32_t cell = start;
    for (uint32_t step = 1; step <= kMostSteps; ++step) {
        const auto weights = cell_weights(cell);
        if (!weights) return {{}, step, false};
        if (weights->inside_measure() >= 0.0) return {finish(cell, *weights), step, false};
        std::array<uint32_t, 4> beyond{};
        uint32_t count = 0;
        for (int i = 0; i < 4; ++i) {
            if (weights->weights[i] < 0.0) {
                beyond[count++] = volume_.cells[cell].neighbors[static_cast<size_t>(i)];
            }
        }
        const auto& neighbors = volume_.cells[cell].neighbors;
        const bool is_lost = count == 0 || random() % kStray == 0;
        cell = is_lost ? neighbors[random() % neighbors.size()] : beyond[random() % count];
    }
    return {{}, kMostSteps, false};
}

/// The next cell of a walk depends only on the current one: a walk that returns to a cell cycles
/// for ever. It is detected by comparing with a cell that is replaced after 1, 2, 4... steps (Brent
/// 1980, "An Improved Monte Carlo Factorization Algorithm").
LocationTrace Walk::walk_from(uint32_t start, size_t cells_near) const {
    uint32_t cell = start;
    uint32_t landmark = kNoIndex;
    uint32_t previous = kNoIndex;
    CellWeights previous_weights;
    uint32_t steps = 1;
    for (; cell != landmark; ++steps) {
        if (std::has_single_bit(steps)) landmark = cell;
        const auto weights = cell_weights(cell);
        if (!weights) break;
        const double measure = weights->inside_measure();
        if (measure >= 0) return {finish(cell, *weights), steps, false};
        const uint32_t next = volume_.cells[cell].neighbors[weights->most_negative()];
        if (next == previous) {
            // Each of two neighbors sends the walk to the other. On their shared face that is
            // rounding, and both answers are the same; anything else is a cycle.
            const double previous_measure = previous_weights.inside_measure();
            if (std::max(measure, previous_measure) < -kSettleTolerance) break;
            return {measure >= previous_measure ? finish(cell, *weights)
                                                : finish(previous, previous_weights),
                    steps, false};
        }
        previous = cell;
        previous_weights = *weights;
        cell = next;
    }
    const LocationTrace near = search_near(cell, cells_near);
    return {near.location, steps + near.step_count, false};
}

std::optional<CellWeights> Walk::precise_weights(uint32_t index) const {
    const bool is_tetrahedron =
        volume_.info.dimension == Dimension::Space && index < volume_.info.inner_cell_count;
    if (!is_tetrahedron) return cell_weights(index);
    std::array<glm::dvec3, 4> corners{};
    if (!find_corners(volume_, index, position_, corners)) return std::nullopt;
    return precise_tetrahedron_weights(corners);
}

std::optional<CellWeights> Walk::cell_weights(uint32_t index) const {
    const bool is_inner = index < volume_.info.inner_cell_count;
    std::array<glm::dvec3, 4> corners{};
    if (!find_corners(volume_, index, glm::dvec3(0.0), corners)) return std::nullopt;
    if (is_inner) {
        if (volume_.info.dimension == Dimension::Space && is_far(corners, position_)) {
            return CellWeights{far_signed_volumes(corners, position_)};
        }
        for (glm::dvec3& corner : corners) corner -= position_;
        return inner_weights(corners);
    }
    const uint32_t hull_index = index - volume_.info.inner_cell_count;
    if (hull_index >= volume_.hull_rays.size()) return std::nullopt;
    return hull_weights(corners, volume_.hull_rays[hull_index]);
}

/// A triangle of a plane is a tetrahedron whose fourth corner is far away along the normal; a
/// segment is one with two such corners.
CellWeights Walk::inner_weights(std::array<glm::dvec3, 4> corners) const {
    const glm::dvec3& axis = volume_.info.axis;
    switch (volume_.info.dimension) {
        case Dimension::Space:
            return tetrahedron_weights(corners);
        case Dimension::Plane: {
            const double square = longest_square(corners, 3);
            corners[3] = axis;
            const glm::dvec4 weights = tetrahedron_weights(corners).weights;
            return {{weights.x, weights.y, weights.z, 0.0}, kSliverRounding * (square * square)};
        }
        case Dimension::Line:
            return {{glm::dot(corners[1], axis), -glm::dot(corners[0], axis), 0.0, 0.0}, 0.0};
        default:
            return {{1.0, 0.0, 0.0, 0.0}, 0.0};
    }
}

CellWeights Walk::hull_weights(const std::array<glm::dvec3, 4>& corners,
                               const HullCellRays& rays) const {
    constexpr CellWeights kGoOnInside{{0.0, 0.0, 0.0, -1.0}};
    switch (volume_.info.dimension) {
        case Dimension::Space: {
            const auto weights = weights_from_nearest_corner(corners, rays, position_);
            return weights ? CellWeights{{*weights, 0.0}} : kGoOnInside;
        }
        case Dimension::Plane: {
            const auto weights = hull_edge_weights({corners[0] - position_, corners[1] - position_},
                                                   rays, volume_.info.axis);
            return weights ? CellWeights{{*weights, 0.0, 0.0}} : kGoOnInside;
        }
        default: {
            const bool is_beyond =
                glm::dot(corners[0] - position_, glm::dvec3(rays.rays[0])) <= 0.0;
            return is_beyond ? CellWeights{{1.0, 0.0, 0.0, 0.0}} : kGoOnInside;
        }
    }
}

/// Walks go around where cells are too flat for double, and where probes that stand apart by less
/// than steps of their floats make cells that fold over their neighbors. However they fold, some
/// cell that faces the right way holds the position, and it is near.
LocationTrace Walk::search_near(uint32_t start, size_t count) const {
    if (start >= volume_.cells.size()) return {};  // a broken file
    std::array<uint32_t, kMostCellsNear> cells;
    cells[0] = start;
    size_t found = 1;
    Best best;
    for (size_t next = 0; next < found; ++next) {
        best.consider(cells[next], precise_weights(cells[next]));
        if (best.measure >= 0.0) break;
        for (const uint32_t neighbor : volume_.cells[cells[next]].neighbors) {
            const auto end = cells.begin() + static_cast<std::ptrdiff_t>(found);
            if (found == count || neighbor >= volume_.cells.size()) continue;
            if (std::find(cells.begin(), end, neighbor) == end) cells[found++] = neighbor;
        }
    }
    const bool is_found = best.measure >= -kSettleTolerance;
    return {is_found ? best.location : CellLocation{}, static_cast<uint32_t>(found)};
}

/// The fallback that cannot fail: the cell that is nearest to containing the position. Where
/// rounding leaves no cell with a volume, the nearest probe.
CellLocation Walk::search_all() const {
    Best best;
    for (uint32_t cell = 0; cell < volume_.cells.size(); ++cell) {
        best.consider(cell, precise_weights(cell));
    }
    return best.location.cell != kNoIndex ? best.location : nearest_corner();
}

CellLocation Walk::nearest_corner() const {
    CellLocation nearest;
    double least = std::numeric_limits<double>::infinity();
    for (uint32_t cell = 0; cell < volume_.cells.size(); ++cell) {
        std::array<glm::dvec3, 4> corners{};
        if (!find_corners(volume_, cell, position_, corners)) continue;
        for (int i = 0; i < 4; ++i) {
            const bool is_corner =
                volume_.cells[cell].vertices[static_cast<size_t>(i)] < volume_.positions.size();
            const double square =
                glm::dot(corners[static_cast<size_t>(i)], corners[static_cast<size_t>(i)]);
            if (!is_corner || !(square < least)) continue;
            least = square;
            glm::vec4 weights(0.0f);
            weights[i] = 1.0f;
            nearest = {cell, 0.0f, weights};
        }
    }
    return nearest;
}

}  // namespace tetralight::detail
