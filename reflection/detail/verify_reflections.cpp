// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/section_text.h>
#include <tetralight/reflection/cube.h>
#include <tetralight/reflection/reflection_file.h>

namespace tetralight {
namespace {

/// How far the products of axes may be from those of unit vectors at right angles.
constexpr float kAxisTolerance = 1e-3f;

/// What is wrong with a probe.
struct Problem {
    std::string_view member;
    std::string what;
};

Error wrong(std::string_view field, const std::string& what) {
    return {ErrorCode::Corrupt, std::string(field), "", str_cat(field, ": ", what)};
}

template <class Vector>
std::string shown(const Vector& v) {
    return str_cat('(', v.x, ", ", v.y, ", ", v.z, ')');
}

bool are_axes(const std::array<glm::vec3, 3>& axes) {
    for (size_t i = 0; i < 3; ++i) {
        for (size_t j = i; j < 3; ++j) {
            const float expected = i == j ? 1.0f : 0.0f;
            if (!(std::abs(glm::dot(axes[i], axes[j]) - expected) <= kAxisTolerance)) return false;
        }
    }
    return true;
}

bool is_box_size(const glm::vec3& half_size) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    if (half_size == glm::vec3(kInfinity)) return true;
    return is_finite(half_size) && half_size.x > 0.0f && half_size.y > 0.0f && half_size.z > 0.0f;
}

/// The first problem of a probe; its member is empty if there is none.
Problem problem_of(const ReflectionProbe& probe) {
    if (!is_finite(probe.position)) return {"position", shown(probe.position) + " is not finite"};
    if (!is_finite(probe.box_center)) {
        return {"box_center", shown(probe.box_center) + " is not finite"};
    }
    if (!is_box_size(probe.half_size)) {
        return {"half_size",
                shown(probe.half_size) + " is neither above 0 nor infinite along all three axes"};
    }
    if (!are_axes(probe.axes)) {
        return {"axes", str_cat(shown(probe.axes[0]), ", ", shown(probe.axes[1]), ", ",
                                shown(probe.axes[2]), " are not unit vectors at right angles")};
    }
    if (!std::isfinite(probe.blend_distance) || probe.blend_distance < 0.0f) {
        return {"blend_distance", str_cat(probe.blend_distance, " m is out of range")};
    }
    if (!(probe.validity >= 0.0f && probe.validity <= 1.0f)) {
        return {"validity", str_cat(probe.validity, " is not in [0, 1]")};
    }
    if (!is_finite(probe.irradiance)) return {"irradiance", "is not finite"};
    if (probe.reserved != std::array<uint32_t, 3>{}) return {"reserved", "is not zero"};
    return {};
}

Status check_cube_sizes(const ReflectionsView& v) {
    if (v.size > kLargestCubeSize || !std::has_single_bit(v.size)) {
        return wrong("size", str_cat(v.size, " texels are not a power of two of at most ",
                                     kLargestCubeSize));
    }
    if (v.level_count == 0 || v.level_count > static_cast<uint32_t>(std::bit_width(v.size))) {
        return wrong("level_count",
                     str_cat(v.level_count, " levels do not fit faces of ", v.size, " texels"));
    }
    const size_t most = kMaxReflectionCubes / (1 + v.layers.size());
    if (v.probes.empty() || v.probes.size() > most) {
        return wrong("probes",
                     str_cat("their number, ", v.probes.size(), ", is not in 1 to ", most));
    }
    return Ok{};
}

Status check_layers(const ReflectionsView& v) {
    if (auto status = detail::check_names("layer_names", v.layer_names); !status) return status;
    const size_t name_count = split_names(v.layer_names).size();
    if (name_count != v.layers.size()) {
        return wrong("layer_names", str_cat(name_count, " names for ", v.layers.size(), " layers"));
    }
    for (size_t k = 0; k < v.layers.size(); ++k) {
        const ReflectionLayer& layer = v.layers[k];
        if (!std::isfinite(layer.weight) || layer.weight < 0.0f) {
            return wrong(str_cat("layers[", k, "].weight"),
                         str_cat(layer.weight, " is out of range"));
        }
        if (layer.reserved != std::array<uint32_t, 3>{})
            return wrong(str_cat("layers[", k, "].reserved"), "is not zero");
    }
    if (v.layer_irradiance.size() != v.probes.size() * v.layers.size()) {
        return wrong("layer_irradiance",
                     str_cat(v.layer_irradiance.size(), " elements for ", v.layers.size(),
                             " layers of ", v.probes.size(), " probes"));
    }
    for (size_t i = 0; i < v.layer_irradiance.size(); ++i) {
        if (!is_finite(v.layer_irradiance[i]))
            return wrong(str_cat("layer_irradiance[", i, "]"), "is not finite");
    }
    return Ok{};
}

bool is_finite_texel(const RadianceTexel& texel) {
    constexpr uint16_t kInfinity = 0x7c00;
    return std::ranges::none_of(texel,
                                [](uint16_t half) { return (half & kInfinity) == kInfinity; });
}

/// The texels of so many cubes at a level.
Status check_texels(const ReflectionsView& v, uint32_t level, std::string_view levels,
                    std::span<const RadianceTexel> texels, size_t cube_count) {
    const std::string field = str_cat(levels, "[", level, "]");
    const uint64_t size = v.size >> level, expected = cube_count * kCubeFaceCount * size * size;
    if (texels.size() != expected) {
        return wrong(field, str_cat(texels.size(), " texels instead of ", expected));
    }
    const auto bad = std::ranges::find_if_not(texels, is_finite_texel);
    if (bad == texels.end()) return Ok{};
    return wrong(field, str_cat("texel ", bad - texels.begin(), " is not finite"));
}

}  // namespace

Status verify(const ReflectionsView& reflections) {
    if (auto status = check_cube_sizes(reflections); !status) return status;
    for (size_t i = 0; i < reflections.probes.size(); ++i) {
        const Problem problem = problem_of(reflections.probes[i]);
        if (problem.member.empty()) continue;
        return wrong(str_cat("probes[", i, "].", problem.member), problem.what);
    }
    if (auto status = check_layers(reflections); !status) return status;
    const size_t probe_count = reflections.probes.size(),
                 layer_cubes = probe_count * reflections.layers.size();
    for (uint32_t level = 0; level < reflections.level_count; ++level) {
        if (auto status =
                check_texels(reflections, level, "levels", reflections.levels[level], probe_count);
            !status)
            return status;
        if (auto status = check_texels(reflections, level, "layer_levels",
                                       reflections.layer_levels[level], layer_cubes);
            !status)
            return status;
    }
    return detail::check_metadata_text(reflections.metadata);
}

}  // namespace tetralight
