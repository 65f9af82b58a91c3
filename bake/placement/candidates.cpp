// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/candidates.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <tuple>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/candidate_count.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/grid_bounds.h>
#include <tetralight/bake/placement/lattice.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr int kUp = 1;
/// The search along a line ends after this number of surfaces.
constexpr int kMaxHits = 1024;

struct LineHit {
    glm::dvec3 position{0.0};
    SurfaceSide side;
};

/// All surfaces along a line through the bounds, from its maximum to its minimum.
std::vector<LineHit> hits_along(const TraceScene& traced, const WorldBox& bounds, glm::dvec3 start,
                                int axis) {
    // Starts a little outside, so that the ray hits a roof at the boundary from above.
    const double margin = 1e-3 * std::max(bounds.size()[axis], 1.0);
    start[axis] = bounds.max[axis] + margin;
    const double length = bounds.size()[axis] + 2.0 * margin;
    glm::vec3 direction(0.0f);
    direction[axis] = -1.0f;
    glm::vec3 from = traced.render_from_world(start);
    const float end = from[axis] - static_cast<float>(length);
    std::vector<LineHit> hits;
    for (int i = 0; i < kMaxHits && from[axis] > end; ++i) {
        const auto side = traced.intersect_side({from, direction, from[axis] - end});
        if (!side) break;
        const glm::vec3 hit = from + side->distance * direction;
        hits.push_back({traced.world_from_render(hit), *side});
        from = traced.ray_origin(*side, hit, direction);
    }
    return hits;
}

/// The lines along one axis: a lattice over the other two axes. Each line counts as a candidate.
Result<std::vector<glm::dvec3>> lines_along(const CandidateRule& rule, int axis) {
    WorldBox flat = rule.bounds;
    flat.min[axis] = flat.max[axis] = 0.0;
    return lattice_candidates({flat, rule.spacing, 0.0, {}, rule.max_count, 0});
}

/// Calls `add(line, found)` for each line and concatenates the results in the order of the lines.
template <class Add>
Result<std::vector<glm::dvec3>> join_lines(const std::vector<glm::dvec3>& lines,
                                           const CandidateRule& rule, const Add& add) {
    std::vector<std::vector<glm::dvec3>> found(lines.size());
    parallel_for(lines.size(), rule.thread_count, [&](size_t i) { add(lines[i], found[i]); });
    std::vector<glm::dvec3> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    if (auto status = check_candidate_count(static_cast<double>(all.size()), rule.max_count);
        !status)
        return status.error();
    return all;
}

bool is_floor(const SurfaceSide& side) {
    constexpr float kMinCosine = 0.5f;
    return !side.is_back_face && side.normal.y > kMinCosine;
}

/// A place on a floor.
struct Foot {
    glm::dvec3 position{0.0};
    /// The same in render space, clear of the floor.
    glm::vec3 base{0.0f};
    /// Where lines of sight to the heights above the base begin.
    glm::vec3 eye{0.0f};
};

std::vector<Foot> feet_on_floors(const TraceScene& traced, const WorldBox& bounds,
                                 const glm::dvec3& column) {
    std::vector<Foot> feet;
    for (const LineHit& hit : hits_along(traced, bounds, column, kUp)) {
        if (!is_floor(hit.side)) continue;
        const glm::vec3 base =
            traced.ray_origin(hit.side, traced.render_from_world(hit.position), {0, 1, 0});
        feet.push_back({hit.position, base, base});
    }
    return feet;
}

/// Walkable meshes are simplified: they may lie this much below the floor that they stand for, and
/// below the bounds, metres.
constexpr double kWalkableError = 0.05;

std::vector<Foot> feet_on_walkable(const TraceScene& traced, const WorldBox& bounds,
                                   const WalkableSurface& walkable, const glm::dvec3& column) {
    std::vector<Foot> feet;
    for (const glm::dvec3& position :
         walkable.feet_in_column(column.x, column.z, bounds.max.y, bounds.min.y - kWalkableError)) {
        const glm::dvec3 eye = position + glm::dvec3(0.0, kWalkableError, 0.0);
        feet.push_back(
            {position, traced.render_from_world(position), traced.render_from_world(eye)});
    }
    return feet;
}

std::vector<Foot> feet_in_column(const TraceScene& traced, const CandidateRule& rule,
                                 const glm::dvec3& column) {
    if (rule.walkable == nullptr) return feet_on_floors(traced, rule.bounds, column);
    return feet_on_walkable(traced, rule.bounds, *rule.walkable, column);
}

}  // namespace

Result<std::vector<glm::dvec3>> lattice_candidates(const CandidateRule& rule) {
    const auto lattice = make_lattice(rule.bounds, rule.spacing, rule.max_count);
    if (!lattice) return lattice.error();
    return lattice->positions();
}

Result<std::vector<glm::dvec3>> layer_candidates(const TraceScene& traced,
                                                 const CandidateRule& rule) {
    const auto columns = lines_along(rule, kUp);
    if (!columns) return columns.error();
    auto candidates = join_lines(*columns, rule, [&](const glm::dvec3& column, auto& found) {
        for (const Foot& foot : feet_in_column(traced, rule, column)) {
            for (const double height : rule.heights) {
                const glm::vec3 top(0.0f, static_cast<float>(height), 0.0f);
                if (!is_visible(traced, foot.eye, foot.base + top)) continue;
                const glm::dvec3 candidate = foot.position + glm::dvec3(0.0, height, 0.0);
                if (is_in(rule.bounds, candidate)) found.push_back(candidate);
            }
        }
    });
    if (candidates && candidates->empty()) {
        return Error{
            ErrorCode::InvalidArgument, "mode", "layers",
            str_cat("there is no ", rule.walkable == nullptr ? "floor" : "walkable surface",
                    ", or no room above it in the bounds, in any of ", columns->size(),
                    " columns")};
    }
    return candidates;
}

std::optional<double> height_above_floor(const TraceScene& traced, const glm::dvec3& position) {
    const auto side = traced.intersect_side({traced.render_from_world(position), {0, -1, 0}});
    if (!side || !is_floor(*side)) return std::nullopt;
    return double{side->distance};
}

Result<std::vector<glm::dvec3>> surface_candidates(const TraceScene& traced,
                                                   const CandidateRule& rule) {
    std::vector<glm::dvec3> all;
    for (int axis = 0; axis < 3; ++axis) {
        const auto lines = lines_along(rule, axis);
        if (!lines) return lines.error();
        const auto some = join_lines(*lines, rule, [&](const glm::dvec3& line, auto& found) {
            for (const LineHit& hit : hits_along(traced, rule.bounds, line, axis)) {
                const glm::vec3 facing = glm::abs(hit.side.normal);
                const int main = facing.x >= facing.y && facing.x >= facing.z ? 0
                                 : facing.y >= facing.z                       ? 1
                                                                              : 2;
                if (main != axis) continue;
                const glm::dvec3 off = rule.clearance * glm::dvec3(hit.side.normal);
                for (const glm::dvec3& candidate : {hit.position + off, hit.position - off}) {
                    if (is_in(rule.bounds, candidate)) found.push_back(candidate);
                }
            }
        });
        if (!some) return some.error();
        all.insert(all.end(), some->begin(), some->end());
    }
    if (auto status = check_candidate_count(static_cast<double>(all.size()), rule.max_count);
        !status)
        return status.error();
    if (all.empty()) {
        return Error{ErrorCode::InvalidArgument, "mode", "surface",
                     "there is no surface in the bounds"};
    }
    return all;
}

std::vector<bool> find_crowded(const TraceScene& traced, std::span<const glm::dvec3> positions,
                               double distance) {
    using Key = std::tuple<int64_t, int64_t, int64_t>;
    const auto cell = [&](double x) { return static_cast<int64_t>(std::floor(x / distance)); };
    std::map<Key, std::vector<size_t>> kept;
    std::vector<bool> is_crowded(positions.size(), false);
    for (size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3& p = positions[i];
        const auto [x, y, z] = Key{cell(p.x), cell(p.y), cell(p.z)};
        for (int n = 0; n < 27 && !is_crowded[i]; ++n) {
            const auto near = kept.find({x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1});
            if (near == kept.end()) continue;
            is_crowded[i] = std::ranges::any_of(near->second, [&](size_t other) {
                const glm::dvec3& q = positions[other];
                return glm::distance(p, q) < distance &&
                       (p == q || is_visible(traced, traced.render_from_world(p),
                                             traced.render_from_world(q)));
            });
        }
        if (!is_crowded[i]) kept[{x, y, z}].push_back(i);
    }
    return is_crowded;
}

}  // namespace tetralight
