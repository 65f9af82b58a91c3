// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <tetralight/probes/mixed_lighting.h>
#include <tetralight/probes/no_index.h>

// Lightmaps: baked light of the surfaces of static instances, as texels of square pages. Each
// instance has a rectangle of a page, which its unwrapped UVs are mapped to. Lightmaps owns,
// LightmapsView is what samples read: of Lightmaps in memory or of a mapped file.
//
//     auto file = open_lightmap_file("level.lightmaps");
//     if (!file) return file.error();
//     const LightmapRectangle& place = file->view().rectangles[instance];
//     glm::vec3 irradiance = sample_irradiance(file->view(), place.page, page_uv(place, uv));

namespace tetralight {

/// The longest side of a page, texels.
inline constexpr uint32_t kLargestPageSize = 16384;

/// Scales of halves lie between this and its inverse.
inline constexpr float kLargestLightmapScale = 0x1p64f;

/// The fixed-size facts of lightmaps.
struct LightmapInfo {
    /// Texels along each side of every page, 1 to `kLargestPageSize`.
    uint32_t page_size = 0;
    uint32_t page_count = 0;
    /// The density of texels that the bake was asked for, 1/m. 0: not known.
    float texels_per_meter = 0.0f;
    /// The light of a half in `irradiance` and `light` is its value times this power of two
    /// (`lightmap_scale`).
    float scale = 1.0f;
    /// How mixed lights are in the texels. Indirect: their bounces. Shadowmask: the same, and their
    /// shadows are in `shadow_mask`. Subtractive: their bounces and their direct light.
    MixedLighting mixed_lighting = MixedLighting::Indirect;
    /// Surfaces nearer than this darken `ambient_occlusion`, metres. 0: it is not there.
    float ambient_occlusion_distance = 0.0f;
    /// 0. Readers of this version reject other values.
    std::array<uint32_t, 10> reserved{};

    /// The index of a texel in sections that have one element a texel.
    [[nodiscard]] uint64_t texel_index(uint32_t page, uint32_t x, uint32_t y) const noexcept {
        return (uint64_t{page} * page_size + y) * page_size + x;
    }

    bool operator==(const LightmapInfo&) const = default;
};

static_assert(sizeof(LightmapInfo) == 64 && std::is_trivially_copyable_v<LightmapInfo>);

/// The light that a texel receives over the hemisphere of its normal, for normal maps. For each
/// color channel: φ = ∫ L dω, and v = ∫ L ω dω in world axes. Irradiance on the texel's own normal
/// n is dot(n, v); lightmap/directional_light.h gives that on normals near it. Halves.
struct LightmapTexel {
    std::array<uint16_t, 3> flux{};                   ///< φ, one a channel
    std::array<std::array<uint16_t, 3>, 3> vector{};  ///< v: vector[channel][axis]

    bool operator==(const LightmapTexel&) const = default;
};

static_assert(sizeof(LightmapTexel) == 24 && std::is_trivially_copyable_v<LightmapTexel>);

/// Irradiance on the texel's own normal, in the units of the lights, not divided by π. Halves.
struct IrradianceTexel {
    std::array<uint16_t, 3> rgb{};
    /// 1 (0x3c00): the texel has light, baked or filled from texels beside it. 0: it belongs to no
    /// surface. Not scaled.
    uint16_t coverage = 0;

    bool operator==(const IrradianceTexel&) const = default;
};

static_assert(sizeof(IrradianceTexel) == 8 && std::is_trivially_copyable_v<IrradianceTexel>);

/// `IrradianceTexel::coverage` of a texel with light.
inline constexpr uint16_t kCovered = 0x3c00;

/// Irradiance of one layer on the texel's own normal, at weight 1: halves times the layer's scale.
struct LayerTexel {
    std::array<uint16_t, 3> rgb{};

    bool operator==(const LayerTexel&) const = default;
};

static_assert(sizeof(LayerTexel) == 6 && std::is_trivially_copyable_v<LayerTexel>);

/// How much of four lights a texel sees, times 255: the shadows of static objects. A light's
/// channel is that of its `LightState`; where lights share a channel, it is of the one whose volume
/// contains the texel.
using ShadowMaskTexel = std::array<uint8_t, 4>;

/// Where an instance of the scene lies in the pages: uv_page = uv · scale + offset, where uv in
/// [0, 1] is the unwrapped UV (TEXCOORD_1) of its mesh, from edge to edge of the rectangle.
struct LightmapRectangle {
    glm::vec2 scale{0.0f};   ///< (width, height) / page size
    glm::vec2 offset{0.0f};  ///< (x, y) / page size
    /// kNoIndex: the instance has no lightmap and takes its light from probes.
    uint32_t page = kNoIndex;
    uint32_t x = 0, y = 0, width = 0, height = 0;  ///< texels
    /// Index into `meshes`; kNoIndex: the UVs are not stored.
    uint32_t mesh = kNoIndex;
    std::array<uint32_t, 2> reserved{};

    bool operator==(const LightmapRectangle&) const = default;
};

static_assert(sizeof(LightmapRectangle) == 48 && std::is_trivially_copyable_v<LightmapRectangle>);

/// The unwrapped UVs of one packing of a mesh. Instances share it.
struct LightmapMesh {
    uint64_t geometry_key = 0;  ///< hash of positions and indices
    uint32_t first_corner = 0;  ///< index into `corner_uvs`
    uint32_t triangle_count = 0;
    std::array<uint32_t, 2> reserved{};

    bool operator==(const LightmapMesh&) const = default;
};

static_assert(sizeof(LightmapMesh) == 24 && std::is_trivially_copyable_v<LightmapMesh>);

/// A part of the light whose weight can change (lightmap/relight_lightmaps.h), by `layer_names`.
struct LightmapLayer {
    float weight = 1.0f;  ///< its factor in the light; 1 = as it was baked
    float scale = 1.0f;   ///< of its halves, as `LightmapInfo::scale`
    std::array<uint32_t, 2> reserved{};

    bool operator==(const LightmapLayer&) const = default;
};

static_assert(sizeof(LightmapLayer) == 16 && std::is_trivially_copyable_v<LightmapLayer>);

/// Read-only spans over lightmaps. Cheap to copy; valid as long as its owner.
///
/// Texels are ordered by page, then row, then column. Row 0 lies at v = 0; the center of texel
/// (x, y) is at uv_page ((x + ½) / page_size, (y + ½) / page_size).
struct LightmapsView {
    LightmapInfo info;

    // One a texel.
    std::span<const IrradianceTexel> irradiance;
    std::span<const LightmapTexel> light;  ///< empty: normal maps have no effect
    /// Fraction of the texel's rays that hit front faces or the sky, times 255. Empty: not known.
    std::span<const uint8_t> validity;
    /// Relative standard error of the baked irradiance, a half ≥ 0. Empty: not known.
    std::span<const uint16_t> error;
    std::span<const ShadowMaskTexel> shadow_mask;  ///< empty: no static shadows of mixed lights
    /// How open the hemisphere of the texel is, times 255: 255 = nothing is near. It is in none of
    /// the light. Empty: not known.
    std::span<const uint8_t> ambient_occlusion;

    std::span<const LightmapRectangle> rectangles;  ///< one an instance, in the scene's order
    std::string_view instance_names;                ///< each ended by '\n'; empty: not known
    std::span<const LightmapMesh> meshes;
    std::span<const glm::vec2> corner_uvs;  ///< three a triangle, in [0, 1] of the rectangle

    // Light that can change after the bake. May be empty.
    std::span<const LightmapLayer> layers;
    std::string_view layer_names;                  ///< each ended by '\n'
    std::span<const LayerTexel> layer_irradiance;  ///< layer after layer, one a texel each
    std::span<const LightmapTexel> layer_light;    ///< the same for `light`

    std::string_view metadata;  ///< how the lightmaps were made: a JSON object, or empty

    /// Texels of all pages, as `info` says.
    [[nodiscard]] uint64_t texel_count() const noexcept {
        return uint64_t{info.page_size} * info.page_size * info.page_count;
    }
};

/// Lightmaps in memory.
struct Lightmaps {
    LightmapInfo info;
    std::vector<IrradianceTexel> irradiance;
    std::vector<LightmapTexel> light;
    std::vector<uint8_t> validity;
    std::vector<uint16_t> error;
    std::vector<ShadowMaskTexel> shadow_mask;
    std::vector<uint8_t> ambient_occlusion;
    std::vector<LightmapRectangle> rectangles;
    std::string instance_names;
    std::vector<LightmapMesh> meshes;
    std::vector<glm::vec2> corner_uvs;
    std::vector<LightmapLayer> layers;
    std::string layer_names;
    std::vector<LayerTexel> layer_irradiance;
    std::vector<LightmapTexel> layer_light;
    std::string metadata;

    [[nodiscard]] LightmapsView view() const noexcept;

    bool operator==(const Lightmaps&) const = default;
};

/// Lightmaps that own what a view shows.
[[nodiscard]] Lightmaps copy_lightmaps(const LightmapsView& view);

/// The scale for light up to `largest`, which is finite and ≥ 0: the smallest power of two that
/// brings it to at most 2^15. Values keep 11 bits: the error is at most 2^-12 of each, or 2^-39 of
/// the largest one for those near zero. 1 without light.
[[nodiscard]] float lightmap_scale(float largest) noexcept;

/// Sets scale and offset of a rectangle from its texels. Precondition: the page size is not 0.
void set_page_transform(LightmapRectangle& rectangle, uint32_t page_size) noexcept;

}  // namespace tetralight
