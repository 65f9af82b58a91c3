// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/mapped_texels.h>

#include <algorithm>

#include <tetralight/bake/scene/mapped_normal.h>

namespace tetralight {
namespace {

/// Places of a texel, evenly from its samples; its middle if it has none.
ChartPoint place_of(const TexelMap& map, const TexelMap::Texel& texel, size_t number) {
    const auto samples = map.samples(texel);
    return samples.empty() ? map.center(texel) : samples[number * samples.size() / kMappedNormals];
}

}  // namespace

std::vector<glm::vec3> make_mapped_normals(const Scene& scene, const LightmapLayout& layout,
                                           std::span<const TexelMap> maps,
                                           const LightmapTexels& texels,
                                           std::span<const uint32_t> baked) {
    std::vector<glm::vec3> normals;
    normals.reserve(kMappedNormals * baked.size());
    size_t instance = 0;
    for (const uint32_t texel : baked) {
        while (texel >= texels.first_texel[instance + 1]) ++instance;
        const MeshInstance& placed = scene.instances[instance];
        const Mesh& mesh = scene.meshes[placed.mesh];
        const TexelMap& map = maps[layout.places[instance].packing];
        const TexelMap::Texel& covered = map.texels[texel - texels.first_texel[instance]];
        const glm::vec3& base = texels.surfaces[texel].normal;
        for (size_t i = 0; i < kMappedNormals; ++i) {
            const ChartPoint place = place_of(map, covered, i);
            normals.push_back(mapped_normal(scene,
                                            mesh_point(mesh, place.triangle, place.barycentric),
                                            glm::mat3(placed.world_from_mesh), base));
        }
    }
    return normals;
}

}  // namespace tetralight
