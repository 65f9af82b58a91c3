// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <tetralight/probes/sh.h>

// Reflection probes: cube maps of the light at a few places, for what shines. Level 0 is a
// mirror's; the light of further levels is blurred for rougher surfaces. Each probe has a box, in
// which it is used and on whose sides its light is thought to lie.
//
//     auto file = open_reflection_file("level.ktx2");
//     if (!file) return file.error();
//     const ReflectionBlend blend = blend_reflections(file->view(), position);
//     glm::vec3 radiance = sample_reflections(file->view(), blend, position, mirrored, roughness);

namespace tetralight {

/// The largest face, texels, and the most levels and cubes of a file.
inline constexpr uint32_t kLargestCubeSize = 4096;
inline constexpr uint32_t kMaxReflectionLevels = 13;
inline constexpr uint32_t kMaxReflectionCubes = 65536;

/// The place of a cube, and where it is used.
struct ReflectionProbe {
    /// Where the light was captured, world.
    glm::dvec3 position{0.0};
    /// The center of the box relative to `position`, in world axes, metres.
    glm::vec3 box_center{0.0f};
    /// Half of the box along each of its axes, metres. Infinite: the probe is used everywhere and
    /// its light comes from far away, as that of a sky.
    glm::vec3 half_size{std::numeric_limits<float>::infinity()};
    /// The axes of the box: unit vectors at right angles, in world axes.
    std::array<glm::vec3, 3> axes{glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)};
    /// Outside the box the probe fades out over this distance, metres.
    float blend_distance = 0.0f;
    /// Probes of higher importance hide those of lower importance.
    int32_t importance = 1;
    /// Fraction of the rays of the cube that hit no back face, in [0, 1].
    float validity = 1.0f;
    /// Irradiance of the cube's light, by its level 0.
    IrradianceSh irradiance{};
    std::array<uint32_t, 3> reserved{};

    [[nodiscard]] bool is_everywhere() const noexcept {
        return half_size.x == std::numeric_limits<float>::infinity();
    }

    bool operator==(const ReflectionProbe&) const = default;
};

static_assert(sizeof(ReflectionProbe) == 216 && std::is_trivially_copyable_v<ReflectionProbe>);

/// Radiance of a texel, and 1 (0x3c00). Halves.
using RadianceTexel = std::array<uint16_t, 4>;

/// A part of the light whose weight can change (reflection/relight_reflections.h), by
/// `layer_names`. The light of the cubes is the sum of all layers by their weights.
struct ReflectionLayer {
    float weight = 1.0f;
    std::array<uint32_t, 3> reserved{};

    bool operator==(const ReflectionLayer&) const = default;
};

static_assert(sizeof(ReflectionLayer) == 16 && std::is_trivially_copyable_v<ReflectionLayer>);

/// Read-only spans over reflection probes. Cheap to copy; valid as long as its owner.
struct ReflectionsView {
    /// Texels along a side of a face of level 0; level k has faces of `size >> k`.
    uint32_t size = 0;
    uint32_t level_count = 0;
    std::span<const ReflectionProbe> probes;
    /// The texels of each level: probe after probe, face after face, row after row.
    std::array<std::span<const RadianceTexel>, kMaxReflectionLevels> levels;
    std::span<const ReflectionLayer> layers;
    std::string_view layer_names;  ///< each ended by '\n'
    std::span<const IrradianceSh>
        layer_irradiance;  ///< at weight 1: probe after probe, one a layer
    /// The texels of each level at weight 1: probe after probe, layer after layer, as `levels`.
    std::array<std::span<const RadianceTexel>, kMaxReflectionLevels> layer_levels;
    std::string_view metadata;  ///< how the probes were made: a JSON object, or empty
};

/// Reflection probes in memory.
struct Reflections {
    uint32_t size = 0;
    std::vector<ReflectionProbe> probes;
    std::vector<std::vector<RadianceTexel>> levels;
    std::vector<std::string> names;  ///< of the probes
    std::vector<ReflectionLayer> layers;
    std::string layer_names;
    std::vector<IrradianceSh> layer_irradiance;
    std::vector<std::vector<RadianceTexel>> layer_levels;
    std::string metadata;

    [[nodiscard]] ReflectionsView view() const noexcept;
};

/// The roughness (glTF's, the square root of GGX's α) that a level is blurred for: 1 - sqrt(1 -
/// level / (levels - 1)), so 0 for level 0 and 1 for the last. Levels are denser where lobes are
/// narrow, and as those of Filament and three.js.
[[nodiscard]] float roughness_of_level(uint32_t level, uint32_t level_count) noexcept;

/// The level of a roughness in [0, 1], with a fraction.
[[nodiscard]] float level_of_roughness(float roughness, uint32_t level_count) noexcept;

/// Number of levels of cubes of this size: down to faces of 8 texels, at least one.
[[nodiscard]] uint32_t reflection_level_count(uint32_t size) noexcept;

}  // namespace tetralight
