// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/base/result.h>

// Light probe proxy volumes (LPPVs): an object larger than the space between probes gets a grid of
// light of its own. This header says where the points of that grid are; lppv/lppv.h fills it.
//
//     const auto grid = make_lppv_grid({world_from_object, parts}, {.density = 2.0});
//     const auto lppv = make_lppv(volume, *grid, {});
//     const InterpolatedProbe light = sample_lppv(*lppv, position);

namespace tetralight {

/// Which box a grid fills.
enum class LppvBounds : uint8_t {
    AutomaticLocal,  ///< around the object in its own space: turns and scales with it, fits tightly
    AutomaticWorld,  ///< around the object along the world's axes
    Custom,          ///< `LppvSettings::custom_box`
};

/// Where the number of grid points along each axis comes from.
enum class LppvResolution : uint8_t {
    Automatic,  ///< density × size of the box
    Custom,     ///< `LppvSettings::resolution`
};

/// Which numbers of grid points are allowed.
enum class LppvLimits : uint8_t {
    Any,    ///< 1 to kMaxLppvResolution
    Unity,  ///< the nearest power of two up to 32; larger requests become 32
};

/// Where in the box the grid points lie. A single one lies in the middle either way.
enum class LppvPlacement : uint8_t {
    CellCorners,  ///< the outer ones on the faces of the box
    CellCenters,  ///< half a spacing inside: better where the faces touch walls
};

inline constexpr uint32_t kMaxLppvResolution = 256;
inline constexpr uint32_t kMaxUnityLppvResolution = 32;

/// A box of one mesh of an object.
struct LppvPart {
    glm::dmat4 world_from_part{1.0};
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
};

/// What a grid wraps: the object's own meshes, and those of its children that are to share its
/// grid.
struct LppvObject {
    glm::dmat4 world_from_object{1.0};
    std::span<const LppvPart> parts = {};
};

/// A box of any orientation in an object's space.
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
    /// Grid points a metre: an axis has max(1, round(density · metres)) of them.
    double density = 1.0;
    glm::uvec3 resolution{4, 4, 4};
    LppvLimits limits = LppvLimits::Any;
    LppvPlacement placement = LppvPlacement::CellCorners;
};

/// A grid of points in a box: point (i, j, k) is at first + (i, j, k) · step of the box's space.
struct LppvGrid {
    /// Affine and invertible; may scale, shear and mirror.
    glm::dmat4 world_from_local{1.0};
    glm::dmat4 local_from_world{1.0};
    /// The box.
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
    glm::dvec3 first{0.0};
    /// 0 where an axis has one point or no thickness.
    glm::dvec3 step{0.0};
    glm::uvec3 resolution{1};

    [[nodiscard]] size_t point_count() const noexcept {
        return size_t{resolution.x} * resolution.y * resolution.z;
    }

    /// x fastest, then y.
    [[nodiscard]] size_t point_index(glm::uvec3 point) const noexcept {
        return (size_t{point.z} * resolution.y + point.y) * resolution.x + point.x;
    }

    /// The point of an index.
    [[nodiscard]] glm::uvec3 point(size_t index) const noexcept {
        const size_t row = index / resolution.x;
        return {index % resolution.x, row % resolution.y, row / resolution.y};
    }

    [[nodiscard]] glm::dvec3 world_position(glm::uvec3 point) const noexcept;

    /// Metres between points along each axis.
    [[nodiscard]] glm::dvec3 spacing() const noexcept;

    /// Where a world position lies between the points: (i, j, k), clamped to the outermost. NaN
    /// counts as 0.
    [[nodiscard]] glm::dvec3 point_coordinates(const glm::dvec3& position) const noexcept;

    bool operator==(const LppvGrid&) const = default;
};

/// The grid of an object. An object scaled to nothing along an axis, and a box without thickness,
/// are fine: a density gives such an axis one point; a custom resolution keeps its number, so that
/// an object that is squashed flat keeps its place in an atlas, all of them at one place. Errors
/// say the value: bounds that are not finite or reversed, an object without parts, a transform that
/// is not affine or flattens it askew, and more points than are allowed.
[[nodiscard]] Result<LppvGrid> make_lppv_grid(const LppvObject& object,
                                              const LppvSettings& settings);

}  // namespace tetralight
