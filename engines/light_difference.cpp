// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/light_difference.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <random>

#include <tetralight/engines/detail/probe_light.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/locate.h>

namespace tetralight {
namespace {

constexpr size_t kNormalCount = 14;

/// Along the axes, and into the eight octants.
std::array<glm::vec3, kNormalCount> normals() {
    const float d = 1.0f / std::sqrt(3.0f);
    return {{{1, 0, 0},
             {-1, 0, 0},
             {0, 1, 0},
             {0, -1, 0},
             {0, 0, 1},
             {0, 0, -1},
             {d, d, d},
             {-d, d, d},
             {d, -d, d},
             {-d, -d, d},
             {d, d, -d},
             {-d, d, -d},
             {d, -d, -d},
             {-d, -d, -d}}};
}

using Irradiances = std::array<glm::vec3, kNormalCount>;

Irradiances at_normals(const IrradianceByNormal& light) {
    Irradiances irradiances;
    std::ranges::transform(normals(), irradiances.begin(), light);
    return irradiances;
}

Irradiances at_normals(const IrradianceSh& light) {
    return at_normals([&](const glm::vec3& normal) { return evaluate_irradiance(light, normal); });
}

double largest_difference(const Irradiances& a, const Irradiances& b) {
    double largest = 0.0;
    for (size_t i = 0; i < kNormalCount; ++i) {
        const glm::vec3 e = glm::abs(a[i] - b[i]);
        largest = std::max<double>(largest, std::max({e.x, e.y, e.z}));
    }
    return largest;
}

DifferenceQuantiles quantiles(std::vector<double> values) {
    std::ranges::sort(values);
    const auto at = [&](double share) {
        const auto count = static_cast<double>(values.size());
        return values[std::min(values.size() - 1, static_cast<size_t>(share * count))];
    };
    return {at(0.5), at(0.99), at(0.999), values.back()};
}

/// Length, area or volume of an inner cell, but for a constant factor.
double cell_size(const ProbeVolumeView& volume, const Cell& cell) {
    const glm::dvec3 origin(volume.positions[cell.vertices[0]]);
    std::array<glm::dvec3, 3> edges{};
    const int vertex_count = cell_vertex_count(volume.info.dimension);
    for (int i = 1; i < vertex_count; ++i) {
        edges[i - 1] = glm::dvec3(volume.positions[cell.vertices[i]]) - origin;
    }
    switch (volume.info.dimension) {
        case Dimension::Space:
            return std::abs(glm::dot(edges[0], glm::cross(edges[1], edges[2])));
        case Dimension::Plane:
            return glm::length(glm::cross(edges[0], edges[1]));
        case Dimension::Line:
            return glm::length(edges[0]);
        default:
            return 1.0;
    }
}

/// In [0, 1). The distributions of the standard library differ between implementations.
double fraction(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Evenly random in a cell: weights that are exponentially distributed, ÷ their sum.
glm::dvec3 random_place(const ProbeVolumeView& volume, const Cell& cell, std::mt19937_64& random) {
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    const int vertex_count = cell_vertex_count(volume.info.dimension);
    for (int i = 0; i < vertex_count; ++i) {
        const double weight = -std::log1p(-fraction(random));
        sum += weight * glm::dvec3(volume.positions[cell.vertices[i]]);
        weights += weight;
    }
    return volume.info.world_origin + (weights > 0.0 ? sum / weights : sum);
}

}  // namespace

std::vector<glm::dvec3> random_places(const ProbeVolumeView& volume, uint32_t count,
                                      const std::optional<Box<glm::dvec3>>& box) {
    std::vector<double> sums;
    double sum = 0.0;
    for (uint32_t cell = 0; cell < volume.info.inner_cell_count; ++cell) {
        sum += cell_size(volume, volume.cells[cell]);
        sums.push_back(sum);
    }
    std::vector<glm::dvec3> places;
    if (!(sum > 0.0)) return places;
    std::mt19937_64 random(20260101);
    constexpr uint32_t kTriesForOne = 100;
    for (uint64_t i = 0; i < uint64_t{kTriesForOne} * count && places.size() < count; ++i) {
        const auto found = std::ranges::upper_bound(sums, fraction(random) * sum);
        const auto cell = std::min<size_t>(found - sums.begin(), sums.size() - 1);
        const glm::dvec3 place = random_place(volume, volume.cells[cell], random);
        if (!box || contains(*box, place)) places.push_back(place);
    }
    return places;
}

IrradianceSh light_at(const ProbeVolumeView& volume, const glm::dvec3& position, Walls walls) {
    const CellLocation location = locate(volume, glm::vec3(position));
    return interpolate(volume, location, {.walls = walls}).irradiance;
}

double largest_irradiance(const ProbeVolumeView& volume) {
    double largest = 0.0;
    for (const IrradianceSh& light : detail::probe_light(volume)) {
        largest = std::max(largest, largest_difference(at_normals(light), Irradiances{}));
    }
    return largest;
}

LightDifference measure_difference(const ProbeVolumeView& volume,
                                   const std::vector<glm::dvec3>& places, const LightAt& shown) {
    return measure_difference(volume, places, [&](const glm::dvec3& place) -> IrradianceByNormal {
        return [light = shown(place)](const glm::vec3& normal) {
            return evaluate_irradiance(light, normal);
        };
    });
}

LightDifference measure_difference(const ProbeVolumeView& volume,
                                   const std::vector<glm::dvec3>& places,
                                   const IrradianceAt& shown) {
    LightDifference difference{static_cast<uint32_t>(places.size()), {}, {}};
    const double largest = largest_irradiance(volume);
    if (places.empty() || !(largest > 0.0)) return difference;
    std::vector<double> from_light;
    std::vector<double> without_walls;
    for (const glm::dvec3& place : places) {
        const Irradiances light = at_normals(shown(place));
        for (const auto& [walls, values] : {std::pair{Walls::HideProbes, &from_light},
                                            std::pair{Walls::Ignore, &without_walls}}) {
            const Irradiances expected = at_normals(light_at(volume, place, walls));
            values->push_back(largest_difference(light, expected) / largest);
        }
    }
    difference.from_light = quantiles(std::move(from_light));
    difference.without_walls = quantiles(std::move(without_walls));
    return difference;
}

}  // namespace tetralight
