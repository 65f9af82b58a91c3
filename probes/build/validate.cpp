// SPDX-License-Identifier: Apache-2.0
#include "probes/build/validate.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/text.h"
#include "probes/build/detail/cgal.h"

namespace tetralight {
namespace {

class Validator {
  public:
    explicit Validator(const ProbeVolumeView& volume) : volume_(volume) {
        positions_.assign(volume.exact_positions.begin(), volume.exact_positions.end());
        if (positions_.empty()) {
            for (const glm::vec3& p : volume.positions) {
                positions_.push_back(glm::dvec3(p) + volume.info.world_origin);
            }
        }
        if (!positions_.empty()) center_ = positions_[0];
    }

    ValidationReport run() {
        for (uint32_t i = 0; i < volume_.cells.size(); ++i) {
            i < volume_.info.tetrahedron_count ? check_tetrahedron(i) : check_hull_cell(i);
        }
        check_probes();
        return report_;
    }

  private:
    [[nodiscard]] const glm::dvec3& corner(uint32_t cell, int i) const {
        return positions_[volume_.cells[cell].vertices[i]];
    }

    /// Signed volume of the tetrahedron over a triangle, with its apex at the first probe.
    [[nodiscard]] double volume_over(const glm::dvec3& a, const glm::dvec3& b,
                                     const glm::dvec3& c) const {
        return glm::dot(a - center_, glm::cross(b - center_, c - center_)) / 6.0;
    }

    void check_tetrahedron(uint32_t cell) {
        const glm::dvec3 &a = corner(cell, 0), &b = corner(cell, 1);
        const glm::dvec3 &c = corner(cell, 2), &d = corner(cell, 3);
        if (detail::orientation(a, b, c, d) <= 0) {
            ++report_.inverted_tetrahedra;
            return;
        }
        report_.cell_volume += glm::dot(b - a, glm::cross(c - a, d - a)) / 6.0;
        for (const uint32_t neighbor : volume_.cells[cell].neighbors) {
            if (neighbor >= volume_.info.tetrahedron_count || neighbor < cell) continue;
            if (detail::is_in_circumsphere(a, b, c, d, positions_[opposite(neighbor, cell)])) {
                ++report_.non_delaunay_faces;
            }
        }
    }

    /// The vertex of `cell` across its face to `neighbor`.
    [[nodiscard]] uint32_t opposite(uint32_t cell, uint32_t neighbor) const {
        const Cell& c = volume_.cells[cell];
        const auto face = std::ranges::find(c.neighbors, neighbor) - c.neighbors.begin();
        return c.vertices[static_cast<size_t>(face)];
    }

    void check_hull_cell(uint32_t cell) {
        const glm::dvec3 &a = corner(cell, 0), &b = corner(cell, 1), &c = corner(cell, 2);
        report_.hull_volume += volume_over(a, b, c);
        for (int i = 0; i < 3; ++i) {
            const uint32_t neighbor = volume_.cells[cell].neighbors[i];
            if (neighbor < cell) continue;
            if (detail::orientation(a, b, c, positions_[opposite(neighbor, cell)]) > 0) {
                ++report_.concave_hull_edges;
            }
        }
    }

    void check_probes() {
        std::vector<bool> has_cell(positions_.size(), false);
        std::vector<bool> has_source(positions_.size(), volume_.sources.empty());
        for (uint32_t i = 0; i < volume_.info.tetrahedron_count; ++i) {
            for (const uint32_t probe : volume_.cells[i].vertices) has_cell[probe] = true;
        }
        for (const ProbeSource& source : volume_.sources) has_source[source.probe] = true;
        for (size_t i = 0; i < positions_.size(); ++i) {
            const glm::vec3 rounded(positions_[i] - volume_.info.world_origin);
            report_.probes_without_cell += !has_cell[i];
            report_.probes_without_source += !has_source[i];
            report_.misplaced_float_probes += rounded != volume_.positions[i];
        }
    }

    const ProbeVolumeView& volume_;
    std::vector<glm::dvec3> positions_;
    glm::dvec3 center_{0.0};
    ValidationReport report_;
};

}  // namespace

std::vector<std::string> ValidationReport::problems() const {
    std::vector<std::string> lines;
    const auto add = [&](uint32_t count, const char* what) {
        if (count > 0) lines.push_back(text(count, " ", what));
    };
    add(inverted_tetrahedra, "tetrahedra are inverted or flat");
    add(non_delaunay_faces, "faces break the Delaunay property");
    add(concave_hull_edges, "hull edges are concave");
    add(probes_without_cell, "probes are in no tetrahedron");
    add(probes_without_source, "probes are in no group");
    add(misplaced_float_probes, "float positions differ from the exact ones");
    if (std::abs(cell_volume - hull_volume) > 1e-9 * std::abs(hull_volume)) {
        lines.push_back(text("the cells fill ", cell_volume, " m³ of the hull's ", hull_volume));
    }
    return lines;
}

ValidationReport validate(const ProbeVolumeView& volume) {
    return Validator(volume).run();
}

}  // namespace tetralight
