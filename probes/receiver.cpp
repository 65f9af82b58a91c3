// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/receiver.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include <tetralight/probes/detail/blend_probes.h>
#include <tetralight/probes/edge_visibility.h>

namespace tetralight {
namespace {

/// Distances from the place that a location's weights stand for to the corners of its cell; 0 to
/// those without weight. Precondition: the cell exists.
glm::vec4 corner_distances(const ProbeVolumeView& volume, const CellLocation& location) {
    const Cell& cell = volume.cells[location.cell];
    std::array<glm::vec3, 4> corners{};
    glm::vec3 place(0.0f);
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i) {
        if (!(location.weights[i] > 0.0f)) continue;
        corners[i] = volume.positions[detail::vertex_at(volume, cell, i)];
        place += location.weights[i] * corners[i];
        sum += location.weights[i];
    }
    if (sum > 0.0f) place /= sum;
    glm::vec4 distances(0.0f);
    for (int i = 0; i < 4; ++i) {
        if (location.weights[i] > 0.0f) distances[i] = glm::distance(place, corners[i]);
    }
    return distances;
}

bool has_cell(const ProbeVolumeView& volume, const CellLocation& location) {
    return location.cell < volume.cells.size() && !volume.positions.empty();
}

void hide_behind_walls(const ProbeVolumeView& volume, float radius, CellLocation& location) {
    const uint32_t element = find_visibility(volume, location.cell);
    if (element == kNoIndex) return;
    const CellVisibility& cell = volume.cell_visibility[element];
    if (radius > 0.0f && has_cell(volume, location)) {
        location.weights =
            visible_weights(cell, location.weights, corner_distances(volume, location), radius);
    } else {
        location.weights = visible_weights(cell, location.weights);
    }
}

void exclude_layers(const ProbeVolumeView& volume, uint32_t layers, CellLocation& location) {
    if (volume.rendering_layers.size() != volume.positions.size()) return;
    if (layers == kAllRenderingLayers || !has_cell(volume, location)) return;
    const Cell& cell = volume.cells[location.cell];
    glm::vec4 weights = location.weights;
    bool is_changed = false;
    for (int i = 0; i < 4; ++i) {
        if (!(weights[i] > 0.0f)) continue;
        if ((volume.rendering_layers[detail::vertex_at(volume, cell, i)] & layers) != 0) continue;
        weights[i] *= kOtherLayersShare;
        is_changed = true;
    }
    const float sum = (weights[0] + weights[1]) + (weights[2] + weights[3]);
    if (!is_changed || !(sum > 0.0f)) return;
    const glm::vec4& before = location.weights;
    location.weights = weights * (((before[0] + before[1]) + (before[2] + before[3])) / sum);
}

}  // namespace

CellLocation visible_location(const ProbeVolumeView& volume, CellLocation location,
                              const Receiver& receiver) noexcept {
    if (receiver.walls == Walls::HideProbes) hide_behind_walls(volume, receiver.radius, location);
    exclude_layers(volume, receiver.rendering_layers, location);
    return location;
}

void hide_probes(const ProbeVolumeView& volume, std::span<CellLocation> locations,
                 const Receiver& receiver) noexcept {
    for (CellLocation& location : locations) {
        location = visible_location(volume, location, receiver);
    }
}

float mean_probe_distance(const ProbeVolumeView& volume, const CellLocation& location) noexcept {
    if (!has_cell(volume, location)) return 0.0f;
    const glm::vec4& w = location.weights;
    const float sum = (w[0] + w[1]) + (w[2] + w[3]);
    if (!(sum > 0.0f)) return 0.0f;
    return glm::dot(w, corner_distances(volume, location)) / sum;
}

glm::vec3 push_off_surface(const ProbeVolumeView& volume, glm::vec3 position, glm::vec3 normal,
                           const CellLocation& location, float normal_offset) noexcept {
    return position + normal * (normal_offset * mean_probe_distance(volume, location));
}

}  // namespace tetralight
