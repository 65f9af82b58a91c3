// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/matrix_walk.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace tetralight::bench {

MatrixWalk::MatrixWalk(const ProbeVolumeView& volume) {
    for (uint32_t i = 0; i < volume.info.inner_cell_count; ++i) {
        const Cell& cell = volume.cells[i];
        const auto corner = [&](size_t k) {
            return glm::dvec3(volume.positions[cell.vertices[k]]);
        };
        const glm::dvec3 last = corner(3);
        const glm::dmat3 weights_of = glm::transpose(
            glm::inverse(glm::dmat3(corner(0) - last, corner(1) - last, corner(2) - last)));
        tetrahedra_.push_back(
            {{glm::vec3(weights_of[0]), glm::vec3(weights_of[1]), glm::vec3(weights_of[2])},
             glm::vec3(last),
             cell.neighbors});
    }
}

void MatrixWalk::locate(std::span<const glm::vec3> positions,
                        std::span<CellLocation> locations) const {
    constexpr int kMostSteps = 1000;
    constexpr float kRounding = -1e-5f;
    uint32_t cell = 0;
    for (size_t i = 0; i < positions.size(); ++i) {
        glm::vec4 weights(0.0f);
        for (int step = 0; step < kMostSteps; ++step) {
            const Tetrahedron& at = tetrahedra_[cell];
            const glm::vec3 d = positions[i] - at.last_corner;
            const glm::vec3 w(glm::dot(at.rows[0], d), glm::dot(at.rows[1], d),
                              glm::dot(at.rows[2], d));
            weights = {w, 1.0f - w.x - w.y - w.z};
            int face = weights.x <= weights.y ? 0 : 1;
            if (weights.z < weights[face]) face = 2;
            if (weights.w < weights[face]) face = 3;
            const uint32_t next = at.neighbors[static_cast<size_t>(face)];
            if (weights[face] >= kRounding || next >= tetrahedra_.size()) break;
            cell = next;
        }
        locations[i] = {cell, 0.0f, weights};
    }
}

}  // namespace tetralight::bench
