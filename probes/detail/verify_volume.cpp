// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.h"
#include "probes/probe_file.h"

namespace tetralight {
namespace {

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_finite(const IrradianceSh& sh) {
    return std::ranges::all_of(sh.coefficients, [](const glm::vec3& c) { return is_finite(c); });
}

Status check_count(const char* name, size_t count, size_t expected, bool is_optional) {
    if (count == expected || (is_optional && count == 0)) return Ok{};
    return Error{text("section \"", name, "\": ", count, " elements instead of ", expected)};
}

Status check_counts(const ProbeVolumeView& v) {
    const size_t probes = v.positions.size();
    if (v.info.tetrahedron_count > v.cells.size()) {
        return Error{text("tetrahedron count ", v.info.tetrahedron_count, " is more than the ",
                          v.cells.size(), " cells")};
    }
    const size_t hull_cells = v.cells.size() - v.info.tetrahedron_count;
    for (const Status& status :
         {check_count("irradiance", v.irradiance.size(), probes, true),
          check_count("occlusion", v.occlusion.size(), probes, true),
          check_count("validity", v.validity.size(), probes, true),
          check_count("exact_positions", v.exact_positions.size(), probes, true),
          check_count("hull_rays", v.hull_rays.size(), hull_cells, false)}) {
        if (!status) return status;
    }
    return Ok{};
}

/// Runs `is_good(element)` over a section.
template <class T, class Predicate>
Status check_each(const char* name, std::span<const T> elements, const char* what,
                  Predicate is_good) {
    for (size_t i = 0; i < elements.size(); ++i) {
        if (!is_good(elements[i])) {
            return Error{text("section \"", name, "\": element ", i, ": ", what)};
        }
    }
    return Ok{};
}

Status check_numbers(const ProbeVolumeView& v) {
    const auto finite = [](const auto& value) { return is_finite(value); };
    const auto fraction = [](float f) { return f >= 0.0f && f <= 1.0f; };
    const auto fractions = [&](const glm::vec4& f) {
        return fraction(f.x) && fraction(f.y) && fraction(f.z) && fraction(f.w);
    };
    const auto unit_rays = [](const HullCellRays& cell) {
        return std::ranges::all_of(cell.rays, [](const glm::vec3& ray) {
            return std::abs(ray.x * ray.x + ray.y * ray.y + ray.z * ray.z - 1.0f) < 1e-3f;
        });
    };
    if (!is_finite(v.info.world_origin) || !is_finite(v.info.ambient) ||
        !std::isfinite(v.info.extent)) {
        return Error{"section \"info\": a number is not finite"};
    }
    for (const Status& status :
         {check_each("positions", v.positions, "is not finite", finite),
          check_each("exact_positions", v.exact_positions, "is not finite", finite),
          check_each("irradiance", v.irradiance, "is not finite", finite),
          check_each("occlusion", v.occlusion, "is not in [0, 1]", fractions),
          check_each("validity", v.validity, "is not in [0, 1]", fraction),
          check_each("hull_rays", v.hull_rays, "is not a unit vector", unit_rays)}) {
        if (!status) return status;
    }
    return Ok{};
}

Error cell_error(size_t cell, const std::string& what) {
    return {text("section \"cells\": cell ", cell, ": ", what)};
}

/// A neighbor shares all vertices but one with the cell, and lists the cell as its neighbor.
bool is_neighbor(const ProbeVolumeView& v, uint32_t cell, int face) {
    const Cell& here = v.cells[cell];
    const Cell& there = v.cells[here.neighbors[face]];
    if (std::ranges::find(there.neighbors, cell) == there.neighbors.end()) return false;
    for (int i = 0; i < 4; ++i) {
        const uint32_t vertex = here.vertices[i];
        if (i == face || vertex == kNoIndex) continue;
        if (std::ranges::find(there.vertices, vertex) == there.vertices.end()) return false;
    }
    return true;
}

Status check_cell(const ProbeVolumeView& v, uint32_t index) {
    const Cell& cell = v.cells[index];
    const int corner_count = index < v.info.tetrahedron_count ? 4 : 3;
    for (int i = 0; i < 4; ++i) {
        const uint32_t vertex = cell.vertices[i];
        if (i < corner_count ? vertex >= v.positions.size() : vertex != kNoIndex) {
            return cell_error(index, text("vertex ", vertex, " is out of range (",
                                          v.positions.size(), " probes)"));
        }
        if (cell.neighbors[i] >= v.cells.size()) {
            return cell_error(index, text("neighbor ", cell.neighbors[i], " is out of range (",
                                          v.cells.size(), " cells)"));
        }
        if (!is_neighbor(v, index, i)) {
            return cell_error(index, text("cell ", cell.neighbors[i], " is not its neighbor"));
        }
    }
    return Ok{};
}

Status check_cells(const ProbeVolumeView& v) {
    for (uint32_t i = 0; i < v.cells.size(); ++i) {
        if (auto status = check_cell(v, i); !status) return status;
    }
    return Ok{};
}

Status check_names(const char* section, std::string_view names) {
    if (names.empty() || names.back() == '\n') return Ok{};
    return Error{text("section \"", section, "\": the last name does not end")};
}

Status check_tables(const ProbeVolumeView& v) {
    if (auto status = check_names("group_names", v.group_names); !status) return status;
    if (auto status = check_names("light_names", v.light_names); !status) return status;
    const size_t groups = split_names(v.group_names).size();
    const size_t light_names = split_names(v.light_names).size();
    if (auto status = check_count("light_names", light_names, v.lights.size(), true); !status) {
        return status;
    }
    const auto in_range = [&](const ProbeSource& source) {
        return source.group < groups && source.probe < v.positions.size();
    };
    const auto is_light = [](const Light& light) {
        return light.type <= LightType::Spot && light.mode <= LightMode::Baked &&
               is_finite(light.intensity) && is_finite(light.position) &&
               is_finite(light.direction);
    };
    if (auto s = check_each("sources", v.sources, "is out of range", in_range); !s) return s;
    return check_each("lights", v.lights, "is not a light", is_light);
}

}  // namespace

Status verify(const ProbeVolumeView& volume) {
    if (auto status = check_counts(volume); !status) return status;
    if (auto status = check_numbers(volume); !status) return status;
    if (auto status = check_cells(volume); !status) return status;
    return check_tables(volume);
}

}  // namespace tetralight
