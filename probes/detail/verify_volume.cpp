// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include <tetralight/base/compiler.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/detail/verify_info.h>
#include <tetralight/probes/detail/verify_layers.h>
#include <tetralight/probes/detail/verify_seed_grid.h>
#include <tetralight/probes/detail/verify_visibility.h>
#include <tetralight/probes/farthest_position.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/section_error.h>
#include <tetralight/probes/section_text.h>

namespace tetralight {
namespace {

using tetralight::is_finite;

bool is_plausible(const Light& light) {
    const float numbers[] = {light.range,  light.cos_inner_cone,      light.cos_outer_cone,
                             light.radius, light.indirect_multiplier, light.width,
                             light.height};
    return light.type <= LightType::Disc && light.mode <= LightMode::Realtime &&
           light.falloff <= LightFalloff::Legacy && is_finite(light.intensity) &&
           is_finite(light.position) && is_finite(light.direction) && is_finite(light.tangent) &&
           std::ranges::all_of(numbers, [](float f) { return std::isfinite(f); });
}

/// Exponents of all ones are infinities and NaNs.
bool is_finite(const CompactProbe& probe) {
    const auto finite = [](uint16_t half) { return (half & 0x7c00) != 0x7c00; };
    return std::ranges::all_of(probe.irradiance, finite) &&
           std::ranges::all_of(probe.occlusion, finite) && finite(probe.validity);
}

Status check_count(const char* name, size_t count, size_t expected, bool is_optional) {
    if (count == expected || (is_optional && count == 0)) return Ok{};
    return detail::section_error(name, str_cat(count, " elements instead of ", expected));
}

Error info_error(const std::string& what) {
    return detail::section_error("info", what);
}

/// Checks that the first cell has as many vertices as the dimension says. If not, the error is
/// about the dimension, not about every cell.
Status check_dimension(const ProbeVolumeView& v) {
    if (v.info.inner_cell_count == 0) return Ok{};
    const auto count = 4 - std::ranges::count(v.cells[0].vertices, kNoIndex);
    if (count == cell_vertex_count(v.info.dimension)) return Ok{};
    return info_error(str_cat("dimension ", static_cast<uint32_t>(v.info.dimension),
                              " does not go with cells of ", count, " vertices"));
}

Status check_counts(const ProbeVolumeView& v) {
    const size_t probes = v.positions.size();
    if (v.info.dimension > Dimension::Space) {
        return info_error(
            str_cat("dimension ", static_cast<uint32_t>(v.info.dimension), " is unknown"));
    }
    if (v.info.inner_cell_count > v.cells.size()) {
        return info_error(str_cat("inner cell count ", v.info.inner_cell_count,
                                  " is more than the ", v.cells.size(), " cells"));
    }
    if (auto status = check_dimension(v); !status) return status;
    const size_t hull_cells = v.cells.size() - v.info.inner_cell_count;
    for (const Status& status :
         {check_count("irradiance", v.irradiance.size(), probes, true),
          check_count("occlusion", v.occlusion.size(), probes, true),
          check_count("validity", v.validity.size(), probes, true),
          check_count("health", v.health.size(), probes, true),
          check_count("compact", v.compact.size(), probes, true),
          check_count("exact_positions", v.exact_positions.size(), probes, true),
          check_count("rendering_layers", v.rendering_layers.size(), probes, true),
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
        if (!is_good(elements[i])) return detail::element_error(name, i, what);
    }
    return Ok{};
}

Status check_numbers(const ProbeVolumeView& v) {
    const auto finite = [](const auto& value) { return is_finite(value); };
    const auto fraction = [](float f) { return f >= 0.0f && f <= 1.0f; };
    const auto fractions = [&](const glm::vec4& f) {
        return fraction(f.x) && fraction(f.y) && fraction(f.z) && fraction(f.w);
    };
    const auto light = [](const IrradianceSh& sh) {
        return largest_coefficient(std::span(&sh, 1)) <= kLargestCoefficient && is_finite(sh);
    };
    const auto plausible = [](const ProbeHealth& health) {
        const glm::vec3& offset = health.virtual_offset;
        const float farthest =
            std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
        return std::isfinite(health.standard_error) && health.standard_error >= 0.0f &&
               health.surface_distance >= 0.0f && is_finite(offset) &&
               double{farthest} <= kFarthestPosition && health.is_dilated <= 1;
    };
    const size_t ray_count =
        static_cast<size_t>(std::max(cell_vertex_count(v.info.dimension) - 1, 0));
    const auto some_layer = [](uint32_t layers) { return layers != 0; };
    const auto unit_rays = [&](const HullCellRays& cell) {
        return std::all_of(
            cell.rays.begin(), cell.rays.begin() + ray_count, [](const glm::vec3& ray) {
                return std::abs(ray.x * ray.x + ray.y * ray.y + ray.z * ray.z - 1.0f) < 1e-3f;
            });
    };
    for (const Status& status :
         {check_each("positions", v.positions, "is not finite", finite),
          check_each("exact_positions", v.exact_positions, "is not finite", finite),
          check_each("irradiance", v.irradiance, "is not finite, or above 1e37", light),
          check_each("compact", v.compact, "is not finite", finite),
          check_each("occlusion", v.occlusion, "is not in [0, 1]", fractions),
          check_each("validity", v.validity, "is not in [0, 1]", fraction),
          check_each("rendering_layers", v.rendering_layers, "is on no layer", some_layer),
          check_each("health", v.health, "is not in range", plausible),
          check_each("hull_rays", v.hull_rays, "is not a unit vector", unit_rays)}) {
        if (!status) return status;
    }
    return detail::check_info(v);
}

Error cell_error(size_t cell, const std::string& what) {
    return {ErrorCode::Corrupt, str_cat("cells[", cell, "]"), "",
            str_cat("section \"cells\": cell ", cell, ": ", what)};
}

/// Without branches.
bool contains(const std::array<uint32_t, 4>& indices, uint32_t index) {
    unsigned equal = 0;
    for (const uint32_t other : indices) equal |= static_cast<unsigned>(other == index);
    return equal != 0;
}

/// A neighbor shares all vertices but one with the cell, and lists the cell as its neighbor.
bool is_neighbor(const ProbeVolumeView& v, uint32_t cell, int face) {
    const Cell& here = v.cells[cell];
    const Cell& there = v.cells[here.neighbors[face]];
    bool is_right = contains(there.neighbors, cell);
    for (int i = 0; i < 4; ++i) {
        const uint32_t vertex = here.vertices[i];
        is_right &= (i == face) | (vertex == kNoIndex) | contains(there.vertices, vertex);
    }
    return is_right;
}

/// Which places of a cell hold a vertex, and which a neighbor.
struct CellShape {
    int vertex_count = 0;
    bool has_side_neighbors = false;
    bool has_inner_neighbor = false;

    CellShape(const VolumeInfo& info, uint32_t cell) {
        const bool is_inner = cell < info.inner_cell_count;
        vertex_count = cell_vertex_count(info.dimension) - (is_inner ? 0 : 1);
        has_side_neighbors = vertex_count > 1;
        has_inner_neighbor = !is_inner;
    }

    [[nodiscard]] bool has_neighbor(int place) const {
        return place < vertex_count ? has_side_neighbors : place == 3 && has_inner_neighbor;
    }
};

/// "vertex 7 is out of range (5)". Empty if it is in range, or is kNoIndex in an unused place.
std::string index_problem(const char* what, uint32_t index, bool is_used, size_t count) {
    if (is_used ? index < count : index == kNoIndex) return {};
    return str_cat(what, " ", index, " is out of range (", is_used ? count : 0, ")");
}

Status check_cell(const ProbeVolumeView& v, uint32_t index) {
    const Cell& cell = v.cells[index];
    const CellShape shape(v.info, index);
    for (int i = 0; i < 4; ++i) {
        const bool has_vertex = i < shape.vertex_count;
        std::string problem =
            index_problem("vertex", cell.vertices[i], has_vertex, v.positions.size());
        if (problem.empty()) {
            problem =
                index_problem("neighbor", cell.neighbors[i], shape.has_neighbor(i), v.cells.size());
        }
        if (problem.empty() && shape.has_neighbor(i) && !is_neighbor(v, index, i)) {
            problem = str_cat("cell ", cell.neighbors[i], " is not its neighbor");
        }
        if (!problem.empty()) return cell_error(index, problem);
    }
    return Ok{};
}

/// True if no neighbor is listed twice.
bool are_distinct(const std::array<uint32_t, 4>& neighbors) {
    const auto [a, b, c, d] = neighbors;
    const auto is_same = [](uint32_t x, uint32_t y) { return x == y && x != kNoIndex; };
    return !(is_same(a, b) || is_same(a, c) || is_same(a, d) || is_same(b, c) || is_same(b, d) ||
             is_same(c, d));
}

/// So many cells further on, neighbors are fetched: waiting for them is most of the time.
constexpr uint32_t kAhead = 16;

void prefetch_neighbors(const ProbeVolumeView& v, uint32_t index) {
    for (const uint32_t neighbor : v.cells[index].neighbors) {
        if (neighbor < v.cells.size()) prefetch(&v.cells[neighbor]);
    }
}

/// Compares each pair of neighbors once, from the cell that comes first. If no cell lists a
/// neighbor twice, and neighbors before and after their cells are equally many, then each link to
/// an earlier cell is the other side of one that was compared.
bool are_cells_right(const ProbeVolumeView& v) {
    int64_t later_minus_earlier = 0;
    for (uint32_t index = 0; index < v.cells.size(); ++index) {
        if (index + kAhead < v.cells.size()) prefetch_neighbors(v, index + kAhead);
        const Cell& cell = v.cells[index];
        const CellShape shape(v.info, index);
        bool is_right = are_distinct(cell.neighbors);
        for (int i = 0; i < 4; ++i) {
            const uint32_t vertex = cell.vertices[i], neighbor = cell.neighbors[i];
            const bool has_neighbor = shape.has_neighbor(i);
            is_right &= i < shape.vertex_count ? vertex < v.positions.size() : vertex == kNoIndex;
            is_right &= has_neighbor ? neighbor < v.cells.size() : neighbor == kNoIndex;
            later_minus_earlier += has_neighbor ? (neighbor > index ? 1 : -1) : 0;
        }
        if (!is_right) return false;
        for (int i = 0; i < 4; ++i) {
            const bool is_compared = shape.has_neighbor(i) && cell.neighbors[i] > index;
            if (is_compared && !is_neighbor(v, index, i)) return false;
        }
    }
    return later_minus_earlier == 0;
}

Status check_cells(const ProbeVolumeView& v) {
    if (are_cells_right(v)) return Ok{};
    for (uint32_t i = 0; i < v.cells.size(); ++i) {
        if (auto status = check_cell(v, i); !status) return status;
    }
    return detail::section_error("cells", "two cells are neighbors of each other twice");
}

Status check_tables(const ProbeVolumeView& v) {
    for (const Status& status : {detail::check_sorted_names("group_names", v.group_names),
                                 detail::check_names("light_names", v.light_names),
                                 detail::check_metadata_text(v.metadata)}) {
        if (!status) return status;
    }
    const size_t groups = split_names(v.group_names).size();
    const size_t light_names = split_names(v.light_names).size();
    if (auto status = check_count("light_names", light_names, v.lights.size(), true); !status) {
        return status;
    }
    const auto has_cell = [&](const Seed& seed) { return seed.cell < v.cells.size(); };
    if (auto s = check_each("seeds", v.seeds, "is out of range", has_cell); !s) return s;
    if (!std::ranges::is_sorted(v.seeds, {}, &Seed::hilbert_index)) {
        return detail::section_error("seeds", "is not sorted");
    }
    if (auto s = detail::check_seed_grid(v); !s) return s;
    if (auto s = detail::check_visibility(v); !s) return s;
    const auto in_range = [&](const ProbeSource& source) {
        return source.group < groups &&
               (source.probe < v.positions.size() || source.probe == kNoIndex);
    };
    if (auto s = check_each("sources", v.sources, "is out of range", in_range); !s) return s;
    const auto is_before = [](const ProbeSource& a, const ProbeSource& b) {
        return std::pair(a.group, a.index) <= std::pair(b.group, b.index);
    };
    if (std::ranges::adjacent_find(v.sources, std::not_fn(is_before)) != v.sources.end()) {
        return detail::section_error("sources", "is not sorted");
    }
    if (auto s = check_each("lights", v.lights, "is not a light", is_plausible); !s) return s;
    return detail::check_light_numbers(v);
}

}  // namespace

Status verify(const ProbeVolumeView& volume) {
    if (auto status = check_counts(volume); !status) return status;
    if (auto status = check_numbers(volume); !status) return status;
    if (auto status = check_cells(volume); !status) return status;
    if (auto status = check_tables(volume); !status) return status;
    return detail::check_layers(volume);
}

}  // namespace tetralight
