// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/opening_lines.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include <tetralight/bake/lights/scene_openings.h>

namespace tetralight {
namespace {

const LineStyle kOpeningStyle{{0.30f, 0.75f, 1.00f}, 0.95f, 0.55f, 2.4f};
const LineStyle kSpotStyle{{1.00f, 0.70f, 0.10f}, 0.8f, 0.4f, 1.0f};

/// Points along each edge of an opening whose light is followed.
constexpr int kPoints = 24;

constexpr std::array<glm::vec2, 5> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};

void add_rectangle(const TraceScene& trace_scene, const Opening& opening, GizmoLines& lines) {
    for (size_t i = 0; i < 4; ++i) {
        lines.lines.push_back({trace_scene.world_from_render(opening.point(kCorners[i])),
                               trace_scene.world_from_render(opening.point(kCorners[i + 1]))});
    }
}

/// Where a light falls that enters at a point; none if it does not.
std::optional<glm::dvec3> lit_point(const TraceScene& trace_scene, const Opening& opening,
                                    const Light& light, glm::vec3 entrance) {
    if (glm::dot(light.direction, opening.normal) <= 0.0f) return std::nullopt;
    if (trace_scene.occluded({entrance, -light.direction})) return std::nullopt;
    const auto side = trace_scene.intersect_side({entrance, light.direction});
    if (!side || side->is_back_face) return std::nullopt;
    return trace_scene.world_from_render(entrance + side->distance * light.direction);
}

/// A net over the spot.
void add_spot(const TraceScene& trace_scene, const Opening& opening, const Light& light,
              GizmoLines& lines) {
    std::array<std::optional<glm::dvec3>, size_t{kPoints} * kPoints> points;
    const auto at = [&](int x, int y) -> auto& {
        return points[static_cast<size_t>(y) * kPoints + static_cast<size_t>(x)];
    };
    // Longer steps are jumps to other surfaces.
    const double longest = 0.25 * std::sqrt(static_cast<double>(opening.area()));
    const auto connect = [&](const auto& from, const auto& to) {
        if (from && to && glm::distance(*from, *to) < longest) lines.lines.push_back({*from, *to});
    };
    for (int y = 0; y < kPoints; ++y) {
        for (int x = 0; x < kPoints; ++x) {
            const glm::vec2 u = (glm::vec2(x, y) + 0.5f) / static_cast<float>(kPoints);
            at(x, y) = lit_point(trace_scene, opening, light, opening.point(u));
            if (x > 0) connect(at(x - 1, y), at(x, y));
            if (y > 0) connect(at(x, y - 1), at(x, y));
        }
    }
}

}  // namespace

Result<std::vector<GizmoLines>> make_opening_lines(const Scene& scene) {
    const auto trace_scene = TraceScene::make_static(scene);
    if (!trace_scene) return trace_scene.error();
    GizmoLines rectangles{{}, kOpeningStyle}, spots{{}, kSpotStyle};
    for (const Opening& opening : openings_of(scene, *trace_scene)) {
        add_rectangle(*trace_scene, opening, rectangles);
        for (const Light& light : scene.lights) {
            if (light.type != LightType::Directional || light.mode == LightMode::Realtime) continue;
            add_spot(*trace_scene, opening, light, spots);
        }
    }
    return std::vector{std::move(rectangles), std::move(spots)};
}

}  // namespace tetralight
