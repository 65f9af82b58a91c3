// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include <tetralight/base/result.h>

// Adjustment volumes: what people say about probes in a part of a scene, against what the
// generator and the bake would do by themselves.

namespace tetralight {

enum class AdjustmentShape : uint8_t {
    Box,     ///< of side 1 around the volume's origin
    Sphere,  ///< of radius 1 around it
};

/// A box or a sphere, placed, turned and scaled by its transform, and what holds in it. What is not
/// set is left to larger volumes around, and to the rule without any.
struct ProbeAdjustment {
    std::string name;
    AdjustmentShape shape = AdjustmentShape::Box;
    /// Affine, invertible.
    glm::dmat4 world_from_volume{1.0};
    /// Whether the generator puts no probe here.
    std::optional<bool> forbids_probes;
    /// Metres between the generator's probes.
    std::optional<double> spacing;
    /// Validity that probes have, whatever they see: 1 = in free space, 0 = in geometry.
    std::optional<float> validity;
    /// Factor on the light of probes.
    std::optional<float> intensity;

    bool operator==(const ProbeAdjustment&) const = default;
};

/// What holds at a position: of each setting, that of the smallest volume around it that has one;
/// of equally small ones the first by name.
struct AdjustmentAt {
    bool forbids_probes = false;
    /// The volume that sets the spacing.
    const ProbeAdjustment* spacing = nullptr;
    std::optional<float> validity;
    float intensity = 1.0f;
};

[[nodiscard]] AdjustmentAt adjustment_at(std::span<const ProbeAdjustment> adjustments,
                                         const glm::dvec3& position);

[[nodiscard]] bool contains(const ProbeAdjustment& adjustment, const glm::dvec3& position);

/// Error: a side of a box or the radius of a sphere, which is three times there, is not positive.
[[nodiscard]] Status check_size(AdjustmentShape shape, const glm::dvec3& size);

/// Cubic metres.
[[nodiscard]] double volume_of(const ProbeAdjustment& adjustment);

/// Error, with the volume's name: a transform that is not affine, finite and invertible, a spacing
/// that is not positive, a validity outside of [0, 1], an intensity that is negative or not finite,
/// or nothing that is adjusted.
[[nodiscard]] Status check(const ProbeAdjustment& adjustment);

}  // namespace tetralight
