// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gizmos.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <utility>

#include <tetralight/probes/build/wireframe.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/locate.h>

namespace tetralight {
namespace {

const LineStyle kInnerStyle{{0.85f, 0.96f, 1.00f}, 0.34f, 0.03f, 1.0f};
const LineStyle kHullStyle{{1.00f, 0.74f, 0.32f}, 0.70f, 0.06f, 1.1f};
const LineStyle kCellStyle{{1.00f, 0.86f, 0.20f}, 0.95f, 0.45f, 2.0f};
const LineStyle kWeightStyle{{0.35f, 1.00f, 0.95f}, 0.95f, 0.45f, 1.4f};

/// Length of drawn hull rays as a fraction of the volume's extent: hull cells are infinite.
constexpr float kRayFraction = 0.3f;

/// Radius of a ball as a fraction of the spacing of probes.
constexpr double kBallFraction = 0.1;

std::vector<LineSegment> lines(const Wireframe& wireframe, std::span<const ProbeEdge> edges) {
    std::vector<LineSegment> result;
    for (const auto [a, b] : edges) {
        result.push_back({wireframe.positions[a], wireframe.positions[b]});
    }
    return result;
}

/// The median length of the cells' edges.
double probe_spacing(const Wireframe& wireframe) {
    std::vector<double> lengths;
    for (const auto* edges : {&wireframe.inner_edges, &wireframe.hull_edges}) {
        for (const auto [a, b] : *edges) {
            lengths.push_back(glm::distance(wireframe.positions[a], wireframe.positions[b]));
        }
    }
    if (lengths.empty()) return 1.0;
    const auto median = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, median);
    return *median;
}

std::vector<LightBall> probe_balls(const ProbeVolumeView& volume, float radius) {
    std::vector<LightBall> balls;
    for (uint32_t i = 0; i < volume.probe_count(); ++i) {
        balls.push_back({volume.info.world_origin + glm::dvec3(volume.positions[i]), radius,
                         volume.irradiance.empty() ? volume.info.ambient : volume.irradiance[i]});
    }
    return balls;
}

void add_proxy_balls(const Lppv& lppv, float asked_radius, std::vector<LightBall>& balls) {
    double smallest = 1e30;
    for (int axis = 0; axis < 3; ++axis) {
        const double spacing = lppv.grid.spacing()[axis];
        if (spacing > 0.0) smallest = std::min(smallest, spacing);
    }
    const double radius_from_spacing = smallest < 1e30 ? 2.5 * kBallFraction * smallest : 0.1;
    const float radius =
        asked_radius > 0.0f ? asked_radius : static_cast<float>(radius_from_spacing);
    for (size_t i = 0; i < lppv.irradiance.size(); ++i) {
        balls.push_back({lppv.grid.world_position(lppv.grid.point(i)), radius, lppv.irradiance[i]});
    }
}

/// A cell in world space: its probes and, if it is a hull cell, its rays.
class SelectedCell {
  public:
    SelectedCell(const ProbeVolumeView& volume, const CellLocation& location)
        : volume_(volume), location_(location) {
        if (location.cell >= volume.cells.size()) return;
        for (const uint32_t probe : volume.cells[location.cell].vertices) {
            if (probe < volume.probe_count()) probes_.push_back(probe);
        }
    }

    [[nodiscard]] GizmoLines edges() const {
        GizmoLines result{{}, kCellStyle};
        for (size_t i = 0; i < probes_.size(); ++i) {
            for (size_t j = i + 1; j < probes_.size(); ++j) {
                result.lines.push_back({position(i), position(j)});
            }
        }
        const uint32_t hull_cell = location_.cell - volume_.info.inner_cell_count;
        if (!probes_.empty() && hull_cell < volume_.hull_rays.size()) {
            for (size_t i = 0; i < std::min<size_t>(probes_.size(), 3); ++i) {
                const glm::vec3 ray = volume_.hull_rays[hull_cell].rays[i];
                const double length = kRayFraction * volume_.info.extent;
                result.lines.push_back({position(i), position(i) + length * glm::dvec3(ray)});
            }
        }
        return result;
    }

    void add_probes(const glm::dvec3& selected, float radius, Gizmos& gizmos) const {
        GizmoLines weights{{}, kWeightStyle};
        for (size_t i = 0; i < probes_.size(); ++i) {
            const IrradianceSh& light =
                volume_.irradiance.empty() ? volume_.info.ambient : volume_.irradiance[probes_[i]];
            gizmos.balls.push_back({position(i), radius, light});
            weights.lines.push_back({selected, position(i)});
            char weight[16];
            std::snprintf(weight, sizeof weight, "%.2f",
                          static_cast<double>(location_.weights[static_cast<int>(i)]));
            gizmos.labels.push_back({position(i), weight});
        }
        gizmos.lines.push_back(std::move(weights));
    }

  private:
    [[nodiscard]] glm::dvec3 position(size_t i) const {
        return volume_.info.world_origin + glm::dvec3(volume_.positions[probes_[i]]);
    }

    const ProbeVolumeView& volume_;
    CellLocation location_;
    std::vector<uint32_t> probes_;
};

void add_selection(const ProbeVolumeView& volume, const glm::dvec3& selected, float radius,
                   Gizmos& gizmos) {
    const CellLocation location = locate(volume, glm::vec3(selected));
    const SelectedCell cell(volume, location);
    gizmos.lines.push_back(cell.edges());
    cell.add_probes(selected, radius, gizmos);
    gizmos.balls.push_back({selected, 1.6f * radius, interpolate(volume, location).irradiance});
}

}  // namespace

Gizmos make_gizmos(const ProbeVolumeView& volume, std::span<const Lppv> proxies,
                   const GizmoSettings& settings) {
    Gizmos gizmos;
    const bool needs_wireframe =
        settings.has_cells || settings.has_probes || settings.selection.has_value();
    const Wireframe wireframe = needs_wireframe ? make_wireframe(volume) : Wireframe{};
    const float radius = settings.ball_radius > 0.0f
                             ? settings.ball_radius
                             : static_cast<float>(kBallFraction * probe_spacing(wireframe));
    if (settings.has_cells) {
        gizmos.lines.push_back({lines(wireframe, wireframe.inner_edges), kInnerStyle});
        gizmos.lines.push_back({lines(wireframe, wireframe.hull_edges), kHullStyle});
    }
    if (settings.has_probes) {
        const bool shows_light = settings.probe_color == ProbeColor::Light;
        (shows_light ? gizmos.balls : gizmos.health_balls) = probe_balls(volume, radius);
    }
    if (settings.has_proxies) {
        for (const Lppv& lppv : proxies) {
            add_proxy_balls(lppv, settings.ball_radius, gizmos.balls);
        }
    }
    if (settings.selection) add_selection(volume, *settings.selection, 1.3f * radius, gizmos);
    return gizmos;
}

}  // namespace tetralight
