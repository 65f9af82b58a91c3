// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/probe_adjustment.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

bool is_before(const ProbeAdjustment& a, const ProbeAdjustment& b) {
    const double size_a = volume_of(a), size_b = volume_of(b);
    return size_a != size_b ? size_a < size_b : a.name < b.name;
}

/// The smallest volume that contains a position and has a setting; null if there is none.
template <class Has>
const ProbeAdjustment* smallest(std::span<const ProbeAdjustment> adjustments,
                                const glm::dvec3& position, const Has& has) {
    const ProbeAdjustment* found = nullptr;
    for (const ProbeAdjustment& adjustment : adjustments) {
        if (!has(adjustment) || !contains(adjustment, position)) continue;
        if (found == nullptr || is_before(adjustment, *found)) found = &adjustment;
    }
    return found;
}

Error transform_error(const char* message) {
    return {ErrorCode::InvalidArgument, "transform", "", message};
}

/// Returns invalid_argument: `NAME VALUE REASON`.
template <class Number>
Error setting_error(const char* name, Number value, const char* reason) {
    return {ErrorCode::InvalidArgument, name, str_cat(value), str_cat(name, " ", value, reason)};
}

Status check_transform(const glm::dmat4& transform) {
    for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(transform[i / 4][i % 4]))
            return transform_error("its transform is not finite");
    }
    const bool is_affine = transform[0][3] == 0.0 && transform[1][3] == 0.0 &&
                           transform[2][3] == 0.0 && transform[3][3] == 1.0;
    if (!is_affine) return transform_error("its transform is not affine");
    const double size = std::abs(glm::determinant(glm::dmat3(transform)));
    if (!(size > 0.0) || !std::isfinite(size)) return transform_error("it has no volume");
    return Ok{};
}

Status check_settings(const ProbeAdjustment& a) {
    if (a.spacing && !(*a.spacing > 0.0 && std::isfinite(*a.spacing))) {
        return setting_error("spacing", *a.spacing, " is not a positive length");
    }
    if (a.validity && !(*a.validity >= 0.0f && *a.validity <= 1.0f)) {
        return setting_error("validity", *a.validity, " is not from 0 to 1");
    }
    if (a.intensity && !(*a.intensity >= 0.0f && std::isfinite(*a.intensity))) {
        return setting_error("intensity", *a.intensity, " is negative or not finite");
    }
    if (a.rendering_layers && *a.rendering_layers == 0) {
        return setting_error("rendering_layers", "[]", " names no layer");
    }
    if (!a.forbids_probes && !a.spacing && !a.validity && !a.intensity && !a.rendering_layers) {
        return Error{ErrorCode::InvalidArgument,
                     "it adjusts nothing (forbid, spacing, validity, intensity, "
                     "rendering_layers)"};
    }
    return Ok{};
}

}  // namespace

bool contains(const ProbeAdjustment& adjustment, const glm::dvec3& position) {
    const glm::dvec3 local(glm::inverse(adjustment.world_from_volume) * glm::dvec4(position, 1.0));
    if (adjustment.shape == AdjustmentShape::Sphere) return glm::dot(local, local) <= 1.0;
    return std::max({std::abs(local.x), std::abs(local.y), std::abs(local.z)}) <= 0.5;
}

Status check_adjustment_size(AdjustmentShape shape, const glm::dvec3& size) {
    const char* name = shape == AdjustmentShape::Box ? "size" : "radius";
    for (int i = 0; i < 3; ++i) {
        if (!(size[i] > 0.0)) return setting_error(name, size[i], " is not a positive length");
    }
    return Ok{};
}

double volume_of(const ProbeAdjustment& adjustment) {
    constexpr double kSphere = 4.0 / 3.0 * std::numbers::pi;
    const double unit = adjustment.shape == AdjustmentShape::Sphere ? kSphere : 1.0;
    return unit * std::abs(glm::determinant(glm::dmat3(adjustment.world_from_volume)));
}

AdjustmentAt adjustment_at(std::span<const ProbeAdjustment> adjustments,
                           const glm::dvec3& position) {
    using A = ProbeAdjustment;
    AdjustmentAt at;
    if (adjustments.empty()) return at;
    const auto forbids =
        smallest(adjustments, position, [](const A& a) { return a.forbids_probes.has_value(); });
    if (forbids != nullptr) at.forbids_probes = *forbids->forbids_probes;
    at.spacing = smallest(adjustments, position, [](const A& a) { return a.spacing.has_value(); });
    const auto validity =
        smallest(adjustments, position, [](const A& a) { return a.validity.has_value(); });
    if (validity != nullptr) at.validity = validity->validity;
    const auto intensity =
        smallest(adjustments, position, [](const A& a) { return a.intensity.has_value(); });
    if (intensity != nullptr) at.intensity = *intensity->intensity;
    const auto layers =
        smallest(adjustments, position, [](const A& a) { return a.rendering_layers.has_value(); });
    if (layers != nullptr) at.rendering_layers = layers->rendering_layers;
    return at;
}

Status check_adjustment(const ProbeAdjustment& adjustment) {
    const std::string place = str_cat("adjustment volume \"", adjustment.name, "\"");
    if (auto status = check_transform(adjustment.world_from_volume); !status) {
        return status.error().in(place);
    }
    if (auto status = check_settings(adjustment); !status) return status.error().in(place);
    return Ok{};
}

}  // namespace tetralight
