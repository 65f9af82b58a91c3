// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/verify_info.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/farthest_position.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/section_error.h>

namespace tetralight::detail {
namespace {

Error info_error(std::string_view member, const std::string& what) {
    Error error = section_error("info", what);
    error.field = str_cat("info.", member);
    return error;
}

/// True if a length in single precision is 1, but for rounding.
bool is_unit(const glm::vec3& v) {
    return std::abs(glm::dot(v, v) - 1.0f) < 1e-3f;
}

bool is_far(const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kFarthestPosition;
}

Status check_axis(const VolumeInfo& info) {
    const bool has_axis = info.dimension == Dimension::Line || info.dimension == Dimension::Plane;
    if (!has_axis && info.axis != glm::dvec3(0.0)) {
        return info_error("axis", "only lines and planes have an axis");
    }
    // Beyond 2 the square could overflow.
    const auto& a = info.axis;
    const bool is_small = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}) < 2.0;
    if (!has_axis || (is_small && std::abs(glm::dot(a, a) - 1.0) < 1e-9)) return Ok{};
    return info_error("axis", "the axis is not a unit vector");
}

/// The extent decides from where on positions count as far away: too small a one moves them.
Status check_extent(const ProbeVolumeView& volume) {
    float farthest = 0.0f;
    for (const glm::vec3& p : volume.positions) farthest = std::max(farthest, glm::length(p));
    const float extent = volume.info.extent;
    if (std::abs(extent - farthest) <= 1e-6f * farthest) return Ok{};
    return info_error("extent",
                      str_cat("extent ", extent, " m; the farthest probe is at ", farthest, " m"));
}

Status check_seed_cube(const ProbeVolumeView& volume) {
    const HilbertCube& cube = volume.info.seed_cube;
    if (!is_finite(cube.min) || !std::isfinite(cube.scale)) {
        return info_error("seed_cube", "a number is not finite");
    }
    if (cube.scale < 0.0) {
        return info_error("seed_cube",
                          str_cat("the cube of the seeds has ", cube.scale, " steps a metre"));
    }
    if (is_far(cube.min)) return info_error("seed_cube", "the cube of the seeds is too far away");
    return Ok{};
}

/// What is wrong with a light; empty if nothing is.
std::string_view light_problem(const Light& light) {
    const float sizes[] = {light.intensity.x, light.intensity.y, light.intensity.z,
                           light.range,       light.radius,      light.indirect_multiplier,
                           light.width,       light.height};
    if (std::ranges::any_of(sizes, [](float size) { return !(size >= 0.0f); })) {
        return "has a negative size or intensity";
    }
    if (light.type != LightType::Point && !is_unit(light.direction)) {
        return "has a direction that is not a unit vector";
    }
    const bool is_cone = light.cos_inner_cone >= light.cos_outer_cone &&
                         light.cos_inner_cone <= 1.0f && light.cos_outer_cone >= -1.0f;
    if (light.type == LightType::Spot && !is_cone) return "has no cone";
    if (light.type != LightType::Rectangle) return {};
    if (!is_unit(light.tangent)) return "has a tangent that is not a unit vector";
    if (std::abs(glm::dot(light.tangent, light.direction)) > 1e-3f) {
        return "has a tangent that is not at right angles to its direction";
    }
    return {};
}

}  // namespace

Status check_info(const ProbeVolumeView& volume) {
    const VolumeInfo& info = volume.info;
    if (!is_finite(info.world_origin) || is_far(info.world_origin)) {
        return info_error("world_origin",
                          str_cat("the origin is not within ", kFarthestPosition, " m"));
    }
    const float ambient = largest_coefficient(std::span(&info.ambient, 1));
    if (!is_finite(info.ambient) || ambient > kLargestCoefficient) {
        return info_error("ambient", "a coefficient is not finite, or above 1e37");
    }
    if (!(info.radial_fraction >= 0.0f && info.radial_fraction <= 1.0f)) {
        return info_error("radial_fraction",
                          str_cat(info.radial_fraction, " is not a fraction from 0 to 1"));
    }
    if (!volume.compact.empty()) {
        int exponent = 0;
        const bool is_scale = info.compact_scale > 0.0f && info.compact_scale < 1e38f &&
                              std::frexp(info.compact_scale, &exponent) == 0.5f;
        if (!is_scale) {
            return info_error("compact_scale", str_cat("scale ", info.compact_scale,
                                                       " of compact probes is not a power of two"));
        }
    }
    if (auto status = check_axis(info); !status) return status;
    if (auto status = check_seed_cube(volume); !status) return status;
    return check_extent(volume);
}

Status check_light_numbers(const ProbeVolumeView& volume) {
    for (size_t i = 0; i < volume.lights.size(); ++i) {
        const std::string_view problem = light_problem(volume.lights[i]);
        if (!problem.empty()) return element_error("lights", i, std::string(problem));
    }
    return Ok{};
}

}  // namespace tetralight::detail
