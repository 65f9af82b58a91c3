// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/free_space.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include <tetralight/bake/placement/grid_bounds.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/virtual_offset.h>

namespace tetralight {
namespace {

/// Relative to the clearance: how far a push exceeds it, and the tolerance for rounding.
constexpr float kSlack = 1e-3f;

/// The number of closed solids that contain the position: along a ray to the sky, the surfaces that
/// it leaves through back faces minus those that it enters through front faces.
int solids_around(const TraceScene& traced, glm::vec3 position, glm::vec3 direction) {
    constexpr int kMaxSurfaces = 256;
    int count = 0;
    for (int i = 0; i < kMaxSurfaces; ++i) {
        const auto side = traced.intersect_side({position, direction});
        if (!side) break;
        count += side->is_from_behind ? 1 : -1;
        const glm::vec3 hit = position + side->distance * direction;
        position = traced.ray_origin(*side, hit, direction);
    }
    return count;
}

/// The search for a free position for one candidate.
class Push {
  public:
    Push(const TraceScene& traced, glm::vec3 start, const ClearanceRule& rule)
        : traced_(traced),
          start_(start),
          clearance_(static_cast<float>(rule.clearance)),
          max_push_(static_cast<float>(rule.max_push)),
          bounds_(rule.bounds) {}

    /// Out of geometry, and then away from surfaces.
    [[nodiscard]] std::optional<glm::vec3> out_of_geometry() const {
        const VirtualOffsetSettings search{max_push_, clearance_ * (1.0f + 2.0f * kSlack),
                                           kMinValidity};
        const auto offset = find_virtual_offset(traced_, start_, search);
        if (!offset) return std::nullopt;
        return along_gradient(start_ + *offset);
    }

    /// Away from the nearest surface, from a free position.
    [[nodiscard]] std::optional<glm::vec3> along_gradient(glm::vec3 from) const {
        constexpr int kMaxSteps = 8;
        glm::vec3 place = from;
        for (int i = 0; i < kMaxSteps; ++i) {
            const auto nearest = traced_.nearest_surface(place);
            const float distance = nearest ? glm::distance(place, *nearest) : clearance_;
            if (distance >= clearance_)
                return is_fine(from, place) ? std::optional(place) : std::nullopt;
            if (distance <= kSlack * clearance_) return std::nullopt;
            place += (clearance_ * (1.0f + kSlack) - distance) / distance * (place - *nearest);
        }
        return std::nullopt;
    }

    /// The shortest push along an axis: out of geometry, away from surfaces, or off the surface
    /// that the candidate touches.
    [[nodiscard]] std::optional<glm::vec3> along_axes(bool is_inside, float distance) const {
        constexpr glm::vec3 kAxes[] = {{0, 1, 0},  {0, -1, 0}, {1, 0, 0},
                                       {-1, 0, 0}, {0, 0, 1},  {0, 0, -1}};
        const float touching = touching_distance();
        std::vector<Way> ways;
        for (const glm::vec3& axis : kAxes) {
            if (distance < touching) {
                // A little off the surface that it touches, which would block the way.
                add_way(start_ + touching * axis, axis, ways);
            } else if (!is_inside) {
                add_way(start_, axis, ways);
            } else if (const auto beyond = exit(axis)) {
                add_way(*beyond, axis, ways);
            }
        }
        // Up comes before other ways whose lengths differ only by rounding.
        const float step = kSlack * clearance_;
        std::ranges::stable_sort(ways, {}, [&](const Way& way) {
            return std::round(glm::distance(way.place, start_) / step);
        });
        for (const Way& way : ways) {
            if (is_fine(way.from, way.place)) return way.place;
        }
        return std::nullopt;
    }

    /// Out of an edge or a corner between walls, for a candidate that touches it.
    [[nodiscard]] std::optional<glm::vec3> off_edges(float distance) const {
        if (!(distance < touching_distance())) return std::nullopt;
        for (const float axis_count : {2.0f, 3.0f}) {
            for (int n = 0; n < 27; ++n) {
                const glm::vec3 way(n % 3 - 1, 1 - n / 9, n / 3 % 3 - 1);
                if (glm::dot(way, way) != axis_count) continue;
                const glm::vec3 from = start_ + touching_distance() * glm::normalize(way);
                if (const auto place = along_gradient(from)) return place;
            }
        }
        return std::nullopt;
    }

  private:
    static constexpr float kMinValidity = 0.75f;

    /// A straight way to a position with clearance.
    struct Way {
        glm::vec3 from{0.0f};
        glm::vec3 place{0.0f};
    };

    /// Beyond the first surface along an axis, if the candidate is behind it.
    [[nodiscard]] std::optional<glm::vec3> exit(const glm::vec3& axis) const {
        const auto side = traced_.intersect_side({start_, axis, max_push_});
        if (!side || !side->is_from_behind) return std::nullopt;
        return traced_.ray_origin(*side, start_ + side->distance * axis, axis);
    }

    /// A candidate that is closer to a surface touches it.
    [[nodiscard]] float touching_distance() const { return 2.0f * kSlack * clearance_; }

    void add_way(const glm::vec3& from, const glm::vec3& axis, std::vector<Way>& ways) const {
        constexpr int kMaxSteps = 8;
        glm::vec3 place = from;
        for (int i = 0; i < kMaxSteps && glm::distance(place, start_) <= max_push_; ++i) {
            const auto nearest = traced_.nearest_surface(place);
            const float distance = nearest ? glm::distance(place, *nearest) : clearance_;
            if (distance >= clearance_) {
                ways.push_back({from, place});
                return;
            }
            // No nearer place along the axis has clearance.
            place += (clearance_ * (1.0f + kSlack) - distance) * axis;
        }
    }

    [[nodiscard]] bool is_fine(glm::vec3 from, glm::vec3 place) const {
        return glm::distance(place, start_) <= max_push_ &&
               is_in(bounds_, traced_.world_from_render(place)) &&
               (place == from || is_visible(traced_, from, place)) &&
               classify_point(traced_, place, probe_visibility(traced_, place)) == PointClass::Free;
    }

    const TraceScene& traced_;
    glm::vec3 start_;
    float clearance_;
    float max_push_;
    WorldBox bounds_;
};

}  // namespace

float surface_distance(const TraceScene& traced, glm::vec3 position) {
    const auto nearest = traced.nearest_surface(position);
    return nearest ? glm::distance(position, *nearest) : std::numeric_limits<float>::infinity();
}

std::vector<glm::dvec3> kept_positions(std::span<const PlacedProbe> probes) {
    std::vector<glm::dvec3> positions;
    for (const PlacedProbe& probe : probes) {
        if (is_kept(probe.fate)) positions.push_back(probe.position);
    }
    return positions;
}

PointClass classify_point(const TraceScene& traced, glm::vec3 position,
                          const ProbeVisibility& around) {
    if (around.is_inside()) return PointClass::Inside;
    if (around.behind_fraction == 0.0f) return PointClass::Free;
    constexpr size_t kEvery = 4;
    int inside = 0, outside = 0;
    for (size_t i = 0; i < probe_visibility_directions().size(); i += kEvery) {
        const bool is_in = solids_around(traced, position, probe_visibility_directions()[i]) > 0;
        ++(is_in ? inside : outside);
    }
    // Open surfaces miss sides in some directions, and so do faces that coincide; closed solids
    // agree in all others.
    if (inside > 3 * outside) return PointClass::Inside;
    return outside > 3 * inside ? PointClass::Free : PointClass::Uncertain;
}

bool is_free_with_clearance(const TraceScene& traced, const glm::dvec3& position,
                            double clearance) {
    const glm::vec3 place = traced.render_from_world(position);
    const ProbeVisibility around = probe_visibility(traced, place);
    return around.surface_distance >= (1.0 - kSlack) * clearance &&
           classify_point(traced, place, around) == PointClass::Free;
}

bool is_visible(const TraceScene& traced, glm::vec3 from, glm::vec3 to) {
    return !traced.occluded({from, to - from, 1.0f});
}

PlacedProbe place_probe(const TraceScene& traced, const glm::dvec3& candidate,
                        const ClearanceRule& rule) {
    const glm::vec3 start = traced.render_from_world(candidate);
    const ProbeVisibility around = probe_visibility(traced, start);
    const bool is_inside = classify_point(traced, start, around) == PointClass::Inside;
    PlacedProbe placed{candidate, Fate::Kept, around.surface_distance};
    if (!is_inside && around.surface_distance >= (1.0 - kSlack) * rule.clearance) return placed;

    const Push push(traced, start, rule);
    std::optional<glm::vec3> place;
    if (rule.clearance > 0.0) {
        place = push.along_axes(is_inside, around.surface_distance);
        if (!place) place = push.off_edges(around.surface_distance);
    }
    if (!place) place = is_inside ? push.out_of_geometry() : push.along_gradient(start);
    if (!place) {
        placed.fate = is_inside ? Fate::Inside : Fate::TooClose;
        return placed;
    }
    placed.position = traced.world_from_render(*place);
    // A push along an axis leaves the others as they are. Probes that rounding moves out of the
    // planes of their lattice make flat tetrahedra, across which light jumps.
    for (int i = 0; i < 3; ++i) {
        const double way = std::abs(placed.position[i] - candidate[i]);
        if (way <= kSlack * rule.clearance) placed.position[i] = candidate[i];
    }
    placed.fate = Fate::Pushed;
    placed.surface_distance = surface_distance(traced, traced.render_from_world(placed.position));
    return placed;
}

}  // namespace tetralight
