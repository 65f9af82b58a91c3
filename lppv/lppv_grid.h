// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/base/result.h>

// Light probe proxy volumes (LPPVs): an object that is larger than the distance between probes gets
// a grid of light. This header places the points of the grid; lppv/lppv.h fills it.
//
//     const auto grid = make_lppv_grid({world_from_object, parts}, {.density = 2.0});
//     const auto lppv = make_lppv(volume, *grid, {});
//     const InterpolatedProbe light = sample_lppv(*lppv, position);

namespace tetralight {

/// The box of a grid.
enum class LppvBounds : uint8_t {
    AutomaticLocal,  ///< of the object in its own space: tight, rotates and scales with it
    AutomaticWorld,  ///< of the object along the world's axes
    Custom,          ///< `LppvSettings::custom_box`
};

/// The number of grid points along each axis.
enum class LppvResolution : uint8_t {
    Automatic,  ///< density × size of the box
    Custom,     ///< `LppvSettings::resolution`
};

/// The allowed numbers of grid points along an axis.
enum class LppvLimits : uint8_t {
    Any,    ///< 1 to kMaxLppvResolution
    Unity,  ///< rounded to the nearest power of two up to 32
};

/// The positions of the grid points in the box. A single point lies at the center.
enum class LppvPlacement : uint8_t {
    CellCorners,  ///< outer points on the faces of the box
    CellCenters,  ///< outer points half a spacing inside: better if the faces touch walls
};

inline constexpr uint32_t kMaxLppvResolution = 256;
inline constexpr uint32_t kMaxUnityLppvResolution = 32;

/// The bounding box of one mesh of an object.
struct LppvPart {
    glm::dmat4 world_from_part{1.0};
    glm::dvec3 min{0.0};
    glm::dvec3 max{0.0};
};

/// The meshes that a grid encloses: those of the object, and of the children that use its grid.
struct LppvObject {
    glm::dmat4 world_from_object{1.0};
    std::span<const LppvPart> parts = {};
};

/// An oriented box in an object's space.
struct LppvBox {
    glm::dvec3 center{0.0};
    glm::dvec3 size{1.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};

    bool operator==(const LppvBox&) const = default;
};

struct LppvSettings {
    LppvBounds bounds = LppvBounds::AutomaticLocal;
    LppvBox custom_box = {};
    LppvResolution resolution_mode = LppvResolution::Automatic;
    /// Grid points per metre: an axis has max(1, round(density · metres)) points.
    double density = 1.0;
    glm::uvec3 resolution{4, 4, 4};
    LppvLimits limits = LppvLimits::Any;
    LppvPlacement placement = LppvPlacement::CellCorners;
};

/// A grid of points in a box: point (i, j, k) is at first + (i, j, k) · step in the local space.
struct LppvGrid {
    /// Affine and invertible; may scale, shear and mirror.
    glm::dmat4 world_from_local{1.0};
    glm::dmat4 local_from_world{1.0};
    /// The box, in the local space.
    glm::dvec3 min{0.0};
    glm::dvec3 max{0.0};
    glm::dvec3 first{0.0};
    /// 0 along an axis of one point or without thickness.
    glm::dvec3 step{0.0};
    glm::uvec3 resolution{1};

    [[nodiscard]] size_t point_count() const noexcept {
        return size_t{resolution.x} * resolution.y * resolution.z;
    }

    /// x fastest, then y.
    [[nodiscard]] size_t point_index(glm::uvec3 point) const noexcept {
        return (size_t{point.z} * resolution.y + point.y) * resolution.x + point.x;
    }

    /// The inverse of `point_index`.
    [[nodiscard]] glm::uvec3 point(size_t index) const noexcept {
        const size_t row = index / resolution.x;
        return {index % resolution.x, row % resolution.y, row / resolution.y};
    }

    [[nodiscard]] glm::dvec3 world_position(glm::uvec3 point) const noexcept;

    /// Metres between points along each axis.
    [[nodiscard]] glm::dvec3 spacing() const noexcept;

    /// Grid coordinates (i, j, k) of a world position, clamped to the outermost points. NaN gives
    /// 0.
    [[nodiscard]] glm::dvec3 point_coordinates(const glm::dvec3& position) const noexcept;

    bool operator==(const LppvGrid&) const = default;
};

/// The grid of an object. The box may have no thickness along an axis, and the transform may scale
/// an axis to 0. A density gives such an axis one point. A custom resolution keeps its number of
/// points, which then coincide, so that a flat object keeps its texels in an atlas. Returns
/// invalid_argument, with the setting as field, if bounds are not finite or are reversed, if the
/// object has no parts, if the transform is not affine or is singular in a direction other than its
/// axes, or if the number of points exceeds the limit.
[[nodiscard]] Result<LppvGrid> make_lppv_grid(const LppvObject& object,
                                              const LppvSettings& settings);

}  // namespace tetralight
