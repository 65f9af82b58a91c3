// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include <tetralight/base/result.h>

// Adjustment volumes: boxes and spheres in which the user overrides what the grid generator and the
// bake do with probes.

namespace tetralight {

enum class AdjustmentShape : uint8_t {
    Box,     ///< side 1, centred at the volume's origin
    Sphere,  ///< radius 1, centred at the volume's origin
};

/// A box or a sphere under a transform, and the settings inside it. A setting without a value is
/// taken from a larger volume around the position, or else has its default.
struct ProbeAdjustment {
    std::string name;
    AdjustmentShape shape = AdjustmentShape::Box;
    /// Affine, invertible.
    glm::dmat4 world_from_volume{1.0};
    /// True: the generator places no probes here. False: it does, inside a volume that forbids
    /// them.
    std::optional<bool> forbids_probes;
    /// Distance between the generator's probes, metres.
    std::optional<double> spacing;
    /// Validity of probes, in place of the measured one: 1 = in free space, 0 = in geometry.
    std::optional<float> validity;
    /// Factor on the light of probes, ≥ 0.
    std::optional<float> intensity;
    /// Rendering layers of probes, in place of those of their groups; not 0.
    std::optional<uint32_t> rendering_layers;

    bool operator==(const ProbeAdjustment&) const = default;
};

/// The settings at a position. Each comes from the smallest volume that contains the position and
/// has a value; among volumes of equal size, from the first by name.
struct AdjustmentAt {
    bool forbids_probes = false;
    /// The volume that sets the spacing.
    const ProbeAdjustment* spacing = nullptr;
    std::optional<float> validity;
    float intensity = 1.0f;
    std::optional<uint32_t> rendering_layers;
};

[[nodiscard]] AdjustmentAt adjustment_at(std::span<const ProbeAdjustment> adjustments,
                                         const glm::dvec3& position);

[[nodiscard]] bool contains(const ProbeAdjustment& adjustment, const glm::dvec3& position);

/// Returns invalid_argument, with the field `size` or `radius`, if a side of a box or the radius of
/// a sphere is not positive. The size of a sphere is its radius, three times.
[[nodiscard]] Status check_adjustment_size(AdjustmentShape shape, const glm::dvec3& size);

/// Cubic metres.
[[nodiscard]] double volume_of(const ProbeAdjustment& adjustment);

/// Returns invalid_argument, with the setting as the field, if the transform is not affine, finite
/// and invertible, the spacing is not positive, the validity is outside of [0, 1], the intensity is
/// negative or not finite, there are no rendering layers, or no setting has a value. The message
/// names the volume.
[[nodiscard]] Status check_adjustment(const ProbeAdjustment& adjustment);

}  // namespace tetralight
