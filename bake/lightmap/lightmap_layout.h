// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/charts/pack_charts.h>
#include <tetralight/charts/pack_pages.h>
#include <tetralight/charts/unwrap.h>

// Where the surfaces of a scene lie in the pages of a lightmap:
//
//     meshes → unwrap → pack_charts → one rectangle an instance → pack_pages → LightmapLayout

namespace tetralight {

/// Which UVs lightmaps use.
enum class LightmapUvs : uint8_t {
    Unwrap,  ///< new charts for each mesh
    Keep,    ///< TEXCOORD_1 of meshes that have it, as it is
    Repair,  ///< TEXCOORD_1 if no part of it overlaps and all of it lies in [0, 1], else new charts
};

/// "unwrap", "keep", "repair".
[[nodiscard]] const char* name_of(LightmapUvs uvs) noexcept;

struct LightmapLayoutSettings {
    double texels_per_meter = 10.0;
    uint32_t page_size = 1024;
    LightmapUvs uvs = LightmapUvs::Unwrap;
    UnwrapSettings unwrap{};
    /// Number of threads; 0 = all.
    uint32_t thread_count = 0;
};

/// The charts of a mesh at one density of texels. Instances of one shape and density share it.
struct LightmapPacking {
    uint32_t mesh = 0;
    PackedCharts charts;
    std::vector<uint32_t> triangle_charts;  ///< chart of each triangle
};

/// Where an instance has its texels.
struct LightmapPlace {
    uint32_t packing = kNoIndex;  ///< kNoIndex: it has no lightmap
    PagePlace corner;

    [[nodiscard]] bool has_lightmap() const { return packing != kNoIndex; }
};

struct LightmapLayout {
    uint32_t page_size = 0;
    uint32_t page_count = 0;
    double texels_per_meter = 0.0;
    std::vector<LightmapPacking> packings;
    std::vector<LightmapPlace> places;  ///< one an instance of the scene
    /// One line for each object whose TEXCOORD_1 overlaps or leaves [0, 1].
    std::vector<std::string> warnings;
};

/// True if an instance gets texels: it is static, receives its light from lightmaps, reflects
/// light, and has a lightmap scale above 0.
[[nodiscard]] bool takes_lightmap(const Scene& scene, const MeshInstance& instance);

/// Charts, densities and places of all instances. Instances of one mesh share charts if their
/// transforms differ only by rotation, reflection, translation and uniform scale. Texels have the
/// same size in the world for every scale of an instance, divided by `LightmapUse::scale`.
///
/// The charts of an instance and the places of texels in its rectangle depend on its mesh, shape
/// and density alone, so that other objects move it by whole texels. Deterministic.
///
/// Returns invalid_argument if a setting is out of range, and if an instance does not fit in a
/// page: the message names the instance, the size that its charts need, and the largest lightmap
/// scale.
[[nodiscard]] Result<LightmapLayout> make_lightmap_layout(const Scene& scene,
                                                          const LightmapLayoutSettings& settings);

}  // namespace tetralight
