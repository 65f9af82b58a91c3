// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/validate.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/detail/spread.h>
#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/delaunay/exact_signs.h>
#include <tetralight/probes/recombine.h>

namespace tetralight {
namespace {

/// The vertex of `cell` across its face to `neighbor`.
uint32_t opposite_vertex(const ProbeVolumeView& volume, uint32_t cell, uint32_t neighbor) {
    const Cell& c = volume.cells[cell];
    const auto face = std::ranges::find(c.neighbors, neighbor) - c.neighbors.begin();
    return c.vertices[static_cast<size_t>(face)];
}

/// What rounding can make of a product of lengths like these.
template <class... Vector>
double product_rounding(const Vector&... factors) {
    return 8.0 * std::numeric_limits<double>::epsilon() * (... * glm::length(factors));
}

/// Tetrahedra, and the triangles of their hull.
class SpaceValidator {
  public:
    SpaceValidator(const ProbeVolumeView& volume, std::span<const glm::dvec3> positions,
                   ValidationReport& report)
        : volume_(volume), positions_(positions), report_(report) {}

    void check(uint32_t cell) {
        cell < volume_.info.inner_cell_count ? check_tetrahedron(cell) : check_hull_cell(cell);
    }

  private:
    [[nodiscard]] const glm::dvec3& corner(uint32_t cell, int i) const {
        return positions_[volume_.cells[cell].vertices[i]];
    }

    void check_tetrahedron(uint32_t cell) {
        const glm::dvec3 &a = corner(cell, 0), &b = corner(cell, 1);
        const glm::dvec3 &c = corner(cell, 2), &d = corner(cell, 3);
        if (exact_orientation(a, b, c, d) <= 0) {
            ++report_.inverted_cells;
            return;
        }
        report_.cell_measure += glm::dot(b - a, glm::cross(c - a, d - a)) / 6.0;
        report_.measure_rounding += product_rounding(b - a, c - a, d - a);
        for (const uint32_t neighbor : volume_.cells[cell].neighbors) {
            if (neighbor >= volume_.info.inner_cell_count || neighbor < cell) continue;
            const glm::dvec3& other = positions_[opposite_vertex(volume_, neighbor, cell)];
            report_.non_delaunay_faces += exact_in_sphere(a, b, c, d, other) > 0;
        }
    }

    void check_hull_cell(uint32_t cell) {
        const glm::dvec3 &a = corner(cell, 0), &b = corner(cell, 1), &c = corner(cell, 2);
        const glm::dvec3& apex = positions_[0];  // near the hull, so that little cancels
        report_.hull_measure += glm::dot(a - apex, glm::cross(b - apex, c - apex)) / 6.0;
        report_.measure_rounding += product_rounding(a - apex, b - apex, c - apex);
        for (int i = 0; i < 3; ++i) {
            const uint32_t neighbor = volume_.cells[cell].neighbors[i];
            if (neighbor < cell) continue;
            const glm::dvec3& other = positions_[opposite_vertex(volume_, neighbor, cell)];
            report_.concave_hull_edges += exact_orientation(a, b, c, other) > 0;
        }
    }

    const ProbeVolumeView& volume_;
    std::span<const glm::dvec3> positions_;
    ValidationReport& report_;
};

/// Triangles, and the edges of their hull.
class PlaneValidator {
  public:
    PlaneValidator(const ProbeVolumeView& volume, std::span<const glm::dvec3> positions,
                   ValidationReport& report)
        : volume_(volume),
          positions_(detail::project(positions, volume.info.axis)),
          report_(report) {}

    void check(uint32_t cell) {
        cell < volume_.info.inner_cell_count ? check_triangle(cell) : check_edge(cell);
    }

  private:
    [[nodiscard]] const glm::dvec2& corner(uint32_t cell, int i) const {
        return positions_[volume_.cells[cell].vertices[i]];
    }

    static double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

    void check_triangle(uint32_t cell) {
        const glm::dvec2 &a = corner(cell, 0), &b = corner(cell, 1), &c = corner(cell, 2);
        if (exact_orientation(a, b, c) <= 0) {
            ++report_.inverted_cells;
            return;
        }
        report_.cell_measure += cross(b - a, c - a) / 2.0;
        report_.measure_rounding += product_rounding(b - a, c - a);
        for (const uint32_t neighbor : volume_.cells[cell].neighbors) {
            if (neighbor >= volume_.info.inner_cell_count || neighbor < cell) continue;
            const glm::dvec2& other = positions_[opposite_vertex(volume_, neighbor, cell)];
            report_.non_delaunay_faces += exact_in_circle(a, b, c, other) > 0;
        }
    }

    void check_edge(uint32_t cell) {
        const glm::dvec2 &a = corner(cell, 0), &b = corner(cell, 1);
        report_.hull_measure += cross(a - positions_[0], b - positions_[0]) / 2.0;
        report_.measure_rounding += product_rounding(a - positions_[0], b - positions_[0]);
        const uint32_t next = volume_.cells[cell].neighbors[0];  // shares b
        const glm::dvec2& other = positions_[opposite_vertex(volume_, next, cell)];
        report_.concave_hull_edges += exact_orientation(a, b, other) < 0;
    }

    const ProbeVolumeView& volume_;
    std::vector<glm::dvec2> positions_;
    ValidationReport& report_;
};

void check_line(const ProbeVolumeView& volume, std::span<const glm::dvec3> positions,
                ValidationReport& report) {
    const auto along = [&](uint32_t probe) {
        return glm::dot(positions[probe] - positions[0], volume.info.axis);
    };
    for (uint32_t cell = 0; cell < volume.info.inner_cell_count; ++cell) {
        const auto& v = volume.cells[cell].vertices;
        const double length = along(v[1]) - along(v[0]);
        report.inverted_cells += !(length > 0.0);
        report.cell_measure += length;
    }
    for (uint32_t cell = volume.info.inner_cell_count; cell < volume.cells.size(); ++cell) {
        const glm::dvec3 ray(volume.hull_rays[cell - volume.info.inner_cell_count].rays[0]);
        const double side = glm::dot(ray, volume.info.axis) > 0.0 ? 1.0 : -1.0;
        report.hull_measure += side * along(volume.cells[cell].vertices[0]);
    }
}

/// Rays of hull cells, in volumes of any dimension.
class HullRayValidator {
  public:
    HullRayValidator(const ProbeVolumeView& volume, std::span<const glm::dvec3> positions,
                     ValidationReport& report)
        : volume_(volume),
          positions_(positions),
          report_(report),
          ray_of_vertex_(positions.size(), glm::vec3(0.0f)) {}

    void check(uint32_t cell) {
        if (cell < volume_.info.inner_cell_count || volume_.hull_rays.empty()) return;
        const glm::dvec3 normal = outward_normal(cell);
        const auto& rays = volume_.hull_rays[cell - volume_.info.inner_cell_count].rays;
        for (int i = 0; i < cell_vertex_count(volume_.info.dimension) - 1; ++i) {
            report_.inward_hull_rays += is_inward(glm::dvec3(rays[i]), normal);
            glm::vec3& ray = ray_of_vertex_[volume_.cells[cell].vertices[i]];
            if (ray == glm::vec3(0.0f)) ray = rays[i];
            report_.torn_hull_rays += glm::distance(ray, rays[i]) > kRayTolerance;
        }
    }

  private:
    /// What rounding to floats may change of a unit vector.
    static constexpr float kRayTolerance = 1e-4f;

    [[nodiscard]] glm::dvec3 outward_normal(uint32_t index) const {
        const Cell& cell = volume_.cells[index];
        const glm::dvec3& a = positions_[cell.vertices[0]];
        if (volume_.info.dimension == Dimension::Line) {
            const auto& inner = volume_.cells[cell.neighbors[3]].vertices;
            return a - positions_[inner[0] == cell.vertices[0] ? inner[1] : inner[0]];
        }
        const glm::dvec3& b = positions_[cell.vertices[1]];
        if (volume_.info.dimension == Dimension::Plane) {
            return glm::cross(b - a, volume_.info.axis);
        }
        return glm::cross(b - a, positions_[cell.vertices[2]] - a);
    }

    [[nodiscard]] bool is_inward(const glm::dvec3& ray, const glm::dvec3& normal) const {
        if (glm::dot(ray, normal) < -kRayTolerance * glm::length(normal)) return true;
        return volume_.info.dimension == Dimension::Plane &&
               std::abs(glm::dot(ray, volume_.info.axis)) > kRayTolerance;
    }

    const ProbeVolumeView& volume_;
    std::span<const glm::dvec3> positions_;
    ValidationReport& report_;
    std::vector<glm::vec3> ray_of_vertex_;
};

void check_probes(const ProbeVolumeView& volume, std::span<const glm::dvec3> positions,
                  ValidationReport& report) {
    std::vector<bool> has_cell(positions.size(), false);
    std::vector<bool> has_source(positions.size(), volume.sources.empty());
    for (uint32_t i = 0; i < volume.info.inner_cell_count; ++i) {
        for (const uint32_t probe : volume.cells[i].vertices) {
            if (probe != kNoIndex) has_cell[probe] = true;
        }
    }
    for (const ProbeSource& source : volume.sources) {
        if (source.probe != kNoIndex) has_source[source.probe] = true;  // else it was left out
    }
    for (size_t i = 0; i < positions.size(); ++i) {
        const glm::vec3 rounded(positions[i] - volume.info.world_origin);
        report.probes_without_cell += !has_cell[i];
        report.probes_without_source += !has_source[i];
        report.misplaced_float_probes += rounded != volume.positions[i];
    }
}

std::vector<glm::dvec3> exact_positions(const ProbeVolumeView& volume) {
    if (!volume.exact_positions.empty()) {
        return {volume.exact_positions.begin(), volume.exact_positions.end()};
    }
    std::vector<glm::dvec3> positions;
    for (const glm::vec3& p : volume.positions) {
        positions.push_back(glm::dvec3(p) + volume.info.world_origin);
    }
    return positions;
}

template <class Validator>
void check_cells(Validator validator, size_t cell_count) {
    for (uint32_t cell = 0; cell < cell_count; ++cell) validator.check(cell);
}

}  // namespace

std::vector<std::string> ValidationReport::problems() const {
    std::vector<std::string> lines;
    const auto add = [&](uint32_t count, const char* one, const char* many) {
        if (count > 0) lines.push_back(str_cat(count, " ", count == 1 ? one : many));
    };
    add(inverted_cells, "cell is inverted or has no volume",
        "cells are inverted or have no volume");
    add(non_delaunay_faces, "face breaks the Delaunay property",
        "faces break the Delaunay property");
    add(concave_hull_edges, "hull edge is concave", "hull edges are concave");
    add(inward_hull_rays, "ray of a hull cell points inwards", "rays of hull cells point inwards");
    add(torn_hull_rays, "ray of a hull vertex differs between its cells",
        "rays of hull vertices differ between their cells");
    add(probes_without_cell, "probe is in no cell", "probes are in no cell");
    add(probes_without_source, "probe is in no group", "probes are in no group");
    add(misplaced_float_probes, "float position differs from the exact one",
        "float positions differ from the exact ones");
    add(wrong_compact_probes, "compact probe differs from its floats",
        "compact probes differ from their floats");
    add(wrong_layer_sums, "probe's light is not the sum of its layers",
        "probes' light is not the sum of their layers");
    add(torn_edges, "edge has different visibility in the cells around it",
        "edges have different visibility in the cells around them");
    const double tolerance = 1e-9 * std::abs(hull_measure) + measure_rounding;
    if (std::abs(cell_measure - hull_measure) > tolerance) {
        lines.push_back(str_cat("the cells fill ", cell_measure, " of the hull's ", hull_measure));
    }
    return lines;
}

ValidationReport validate(const ProbeVolumeView& volume) {
    ValidationReport report;
    const std::vector<glm::dvec3> positions = exact_positions(volume);
    if (volume.info.dimension == Dimension::Space) {
        check_cells(SpaceValidator(volume, positions, report), volume.cells.size());
    } else if (volume.info.dimension == Dimension::Plane) {
        check_cells(PlaneValidator(volume, positions, report), volume.cells.size());
    } else if (volume.info.dimension == Dimension::Line) {
        check_line(volume, positions, report);
    }
    check_cells(HullRayValidator(volume, positions, report), volume.cells.size());
    check_probes(volume, positions, report);
    report.wrong_compact_probes = count_wrong_compact_probes(volume);
    report.wrong_layer_sums = count_wrong_sums(volume);
    if (!volume.visibility_blocks.empty()) {
        const VisibilityFacts facts = visibility_facts(volume);
        report.torn_edges = static_cast<uint32_t>(facts.torn_edges + facts.torn_splits);
    }
    return report;
}

}  // namespace tetralight
