// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/fit_holes.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>
#include <vector>

namespace tetralight {
namespace {

// Metres, times the scale.
constexpr float kThickness = 0.3f;  ///< half of that of a wall around a hole
constexpr float kMargin = 0.2f;     ///< least distance of the border of the grid from the places

/// Cells of the grid in each direction, and how often it grows.
constexpr int kGrid = 48;
constexpr int kAttempts = 4;

/// Largest ratio of the distances of the places from their plane and from their center.
constexpr double kMaxFlatness = 0.5;

/// A plane with two axes.
struct Plane {
    glm::vec3 center, u, v, normal;

    Plane(glm::vec3 at, glm::vec3 unit) : center(at), normal(unit) {
        const glm::vec3 side = std::abs(unit.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        u = glm::normalize(glm::cross(side, unit));
        v = glm::cross(unit, u);
    }

    [[nodiscard]] glm::vec2 coordinates(glm::vec3 position) const {
        return {glm::dot(position - center, u), glm::dot(position - center, v)};
    }

    [[nodiscard]] glm::vec3 direction(glm::vec2 p) const { return p.x * u + p.y * v; }
};

glm::dvec3 mean_position(std::span<const NarrowPlace> places) {
    glm::dvec3 sum(0.0);
    for (const NarrowPlace& place : places) sum += glm::dvec3(place.position);
    return sum / static_cast<double>(places.size());
}

/// The plane of least squares, whose normal points against the rays.
std::optional<Plane> plane_of(std::span<const NarrowPlace> places) {
    const glm::dvec3 center = mean_position(places);
    glm::dvec3 direction(0.0);
    glm::dmat3 spread(0.0);
    for (const NarrowPlace& place : places) {
        const glm::dvec3 d = glm::dvec3(place.position) - center;
        spread += glm::outerProduct(d, d);
        direction += glm::dvec3(place.direction);
    }
    const double trace = spread[0][0] + spread[1][1] + spread[2][2];
    const double length = glm::length(direction);
    if (!(trace > 0.0) || !(length > 0.0)) return std::nullopt;
    // The eigenvector of the smallest eigenvalue, by inverse iteration.
    glm::dmat3 regular = spread;
    for (int i = 0; i < 3; ++i) regular[i][i] += 1e-4 * trace;
    const glm::dmat3 inverse = glm::inverse(regular);
    glm::dvec3 normal = direction / length;
    for (int i = 0; i < 20; ++i) normal = glm::normalize(inverse * normal);
    if (glm::dot(normal, direction) > 0.0) normal = -normal;
    const double thickness2 = glm::dot(normal, spread * normal);
    if (thickness2 > kMaxFlatness * kMaxFlatness * trace) return std::nullopt;
    return Plane(glm::vec3(center), glm::vec3(normal));
}

/// Cells of a plane. Those of holes have the number of their hole.
struct Grid {
    static constexpr int kWall = -2, kFree = -1;

    /// Free cells that are connected.
    struct Hole {
        int border_count = 0;  ///< cells at the border of the grid
        int rim_count = 0;     ///< cells beside a wall
    };

    Grid(glm::vec2 lower_corner, glm::vec2 size) : from(lower_corner), cell_size(size) {}

    glm::vec2 from, cell_size;
    std::vector<int> cells = std::vector<int>(size_t{kGrid} * kGrid, kWall);
    std::vector<Hole> holes;

    [[nodiscard]] int& at(int x, int y) { return cells[static_cast<size_t>(y) * kGrid + x]; }

    [[nodiscard]] bool is_beside_wall(int x, int y) {
        return at(x - 1, y) == kWall || at(x + 1, y) == kWall || at(x, y - 1) == kWall ||
               at(x, y + 1) == kWall;
    }
};

class HoleFitter {
  public:
    HoleFitter(const TraceScene& trace_scene, std::span<const NarrowPlace> places, float scale)
        : trace_scene_(trace_scene), places_(places), scale_(scale) {}

    [[nodiscard]] std::vector<Opening> fit() const {
        const auto plane = plane_of(places_);
        if (!plane) return {};
        return holes_in(Plane(plane->center, normal_of_wall(*plane)));
    }

  private:
    /// The mean normal of the surfaces around a hole on its dark side, or that of the plane if they
    /// are few: in thick walls the places do not tell the direction well.
    [[nodiscard]] glm::vec3 normal_of_wall(const Plane& plane) const {
        glm::vec3 sum(0.0f);
        int count = 0;
        for (int i = 0; i < 64; ++i) {
            const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / 16.0f;
            const float radius = 0.4f * scale_ * static_cast<float>(1 + i / 16);
            const glm::vec3 around =
                plane.center + radius * plane.direction({std::cos(angle), std::sin(angle)});
            const float height = 2.0f * kThickness * scale_;
            const auto surface = trace_scene_.intersect_side(
                {around + height * plane.normal, -plane.normal, 2.0f * height});
            if (!surface || glm::dot(surface->normal, plane.normal) < 0.7f) continue;
            sum += surface->normal;
            ++count;
        }
        return count >= 8 ? glm::normalize(sum) : plane.normal;
    }

    /// Looks farther until it finds the edges of all holes: the places may be few.
    [[nodiscard]] std::vector<Opening> holes_in(const Plane& plane) const {
        glm::vec2 low(0.0f), high(0.0f);
        for (const NarrowPlace& place : places_) {
            const glm::vec2 p = plane.coordinates(place.position);
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        Grid grid(low, high);
        for (int attempt = 0; attempt < kAttempts; ++attempt) {
            const glm::vec2 margin = 0.25f * (high - low) + kMargin * scale_;
            low -= margin;
            high += margin;
            grid = Grid(low, (high - low) / static_cast<float>(kGrid));
            find_free_cells(plane, grid);
            find_holes(plane, grid);
            if (std::ranges::all_of(
                    grid.holes, [](const Grid::Hole& hole) { return hole.border_count == 0; })) {
                break;
            }
        }
        std::vector<Opening> openings;
        for (size_t i = 0; i < grid.holes.size(); ++i) {
            // A little leak, through a gap at the floor for example, does not matter.
            const Grid::Hole& hole = grid.holes[i];
            if (hole.border_count == 0 || 4 * hole.border_count < hole.rim_count)
                openings.push_back(smallest_rectangle(grid, static_cast<int>(i), plane));
        }
        return openings;
    }

    void find_free_cells(const Plane& plane, Grid& grid) const {
        const float half = kThickness * scale_;
        for (int y = 0; y < kGrid; ++y) {
            for (int x = 0; x < kGrid; ++x) {
                const glm::vec2 p = grid.from + grid.cell_size * (glm::vec2(x, y) + 0.5f);
                const glm::vec3 from = plane.center + plane.direction(p) - half * plane.normal;
                if (is_free({from, plane.normal, 2.0f * half})) grid.at(x, y) = Grid::kFree;
            }
        }
    }

    /// True if a ray meets glass at most.
    [[nodiscard]] bool is_free(Ray ray) const {
        constexpr int kMostPanes = 4;
        constexpr float kOpaque = 0.95f;
        const float gap = 1e-3f * ray.max_distance;
        for (int i = 0; i <= kMostPanes; ++i) {
            const auto crossing = trace_scene_.nearest_crossing(ray);
            if (!crossing) return true;
            if (crossing->opacity >= kOpaque) return false;
            ray.origin += (crossing->distance + gap) * ray.direction;
            ray.max_distance -= crossing->distance + gap;
            if (ray.max_distance <= 0.0f) return true;
        }
        return false;
    }

    /// Marks the free cells that are connected to those of the places.
    void find_holes(const Plane& plane, Grid& grid) const {
        std::vector<glm::ivec2> stack;
        const auto push = [&](int x, int y, int hole) {
            if (x < 0 || y < 0 || x >= kGrid || y >= kGrid) return;
            if (grid.at(x, y) != Grid::kFree) return;
            grid.at(x, y) = hole;
            stack.emplace_back(x, y);
        };
        for (const NarrowPlace& place : places_) {
            const glm::ivec2 cell((plane.coordinates(place.position) - grid.from) / grid.cell_size);
            const auto number = static_cast<int>(grid.holes.size());
            push(cell.x, cell.y, number);
            if (stack.empty()) continue;
            Grid::Hole& hole = grid.holes.emplace_back();
            while (!stack.empty()) {
                const int x = stack.back().x, y = stack.back().y;
                stack.pop_back();
                if (x == 0 || y == 0 || x == kGrid - 1 || y == kGrid - 1) {
                    ++hole.border_count;
                } else if (grid.is_beside_wall(x, y)) {
                    ++hole.rim_count;
                }
                push(x - 1, y, number);
                push(x + 1, y, number);
                push(x, y - 1, number);
                push(x, y + 1, number);
            }
        }
    }

    [[nodiscard]] static Opening smallest_rectangle(Grid& grid, int hole, const Plane& plane) {
        std::vector<glm::vec2> corners;
        for (int i = 0; i < kGrid * kGrid * 4; ++i) {
            const int x = i / 4 % kGrid, y = i / 4 / kGrid;
            if (grid.at(x, y) != hole) continue;
            corners.push_back(grid.from + grid.cell_size * glm::vec2(x + i % 2, y + i / 2 % 2));
        }
        constexpr int kTurns = 18;
        float best = std::numeric_limits<float>::max();
        Opening opening;
        for (int turn = 0; turn < kTurns; ++turn) {
            const float angle =
                0.5f * std::numbers::pi_v<float> * static_cast<float>(turn) / kTurns;
            const glm::vec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
            glm::vec2 low(std::numeric_limits<float>::max()), high(-low);
            for (const glm::vec2& corner : corners) {
                const glm::vec2 p(glm::dot(corner, along), glm::dot(corner, across));
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            const glm::vec2 extent = high - low;
            if (!(extent.x * extent.y < 0.999f * best)) continue;
            best = extent.x * extent.y;
            opening = {plane.center + plane.direction(low.x * along + low.y * across),
                       extent.x * plane.direction(along), extent.y * plane.direction(across),
                       plane.normal};
        }
        return opening;
    }

    const TraceScene& trace_scene_;
    std::span<const NarrowPlace> places_;
    float scale_ = 1.0f;
};

}  // namespace

std::vector<Opening> fit_holes(const TraceScene& trace_scene, std::span<const NarrowPlace> places,
                               float scale) {
    return HoleFitter(trace_scene, places, scale).fit();
}

}  // namespace tetralight
