// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/lightmap_glb.h>

#include <string>

#include <tetralight/bake/scene/detail/gltf_meshes.h>
#include <tetralight/bake/scene/detail/gltf_nodes.h>
#include <tetralight/bake/scene/detail/gltf_parts.h>
#include <tetralight/bake/scene/detail/gltf_pose.h>
#include <tetralight/bake/scene/detail/gltf_probe_groups.h>
#include <tetralight/bake/scene/detail/lightmap_meshes.h>
#include <tetralight/bake/scene/detail/lightmap_nodes.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr uint32_t kLinearFilter = 9729, kClampToEdge = 33071;

/// Adds the images of the pages as textures; returns the index of the first one.
uint32_t add_page_textures(const GltfLightmaps& lightmaps, detail::GltfParts& parts) {
    const uint32_t sampler = parts.add("samplers", {{"magFilter", kLinearFilter},
                                                    {"minFilter", kLinearFilter},
                                                    {"wrapS", kClampToEdge},
                                                    {"wrapT", kClampToEdge}});
    const size_t first = parts.json.contains("textures") ? parts.json["textures"].size() : 0;
    for (size_t page = 0; page < lightmaps.pages.size(); ++page) {
        const std::string name = "lightmap " + std::to_string(page);
        const uint32_t view = parts.add_view(lightmaps.pages[page]);
        const uint32_t image =
            parts.add("images", {{"name", name}, {"mimeType", "image/png"}, {"bufferView", view}});
        const detail::GltfJson rgbm = {{"MX_texture_rgbm", detail::GltfJson::object()}};
        parts.add("textures",
                  {{"name", name}, {"sampler", sampler}, {"source", image}, {"extensions", rgbm}});
    }
    parts.use_extension("MX_lightmap");
    parts.use_extension("MX_texture_rgbm");
    return static_cast<uint32_t>(first);
}

Result<std::vector<std::byte>> lightmapped(const detail::GltfDocument& document,
                                           const GltfLightmaps& lightmaps) {
    const auto nodes = detail::flatten_nodes(document);
    if (!nodes) return nodes.error();
    const auto groups = detail::read_gltf_probe_groups(document, *nodes);
    if (!groups) return groups.error();
    auto meshes = detail::read_meshes(document, NormalMaps::Skip);
    if (!meshes) return meshes.error();
    const auto posed = detail::pose_meshes(document, *nodes, NormalMaps::Skip, *meshes);
    if (!posed) return posed.error();
    const auto objects =
        detail::lightmap_objects(document, *nodes, groups->is_probe, *meshes, lightmaps.places);
    if (!objects) return objects.error();
    auto parts = detail::GltfParts::open(document);
    if (!parts) return parts.error();
    auto written =
        detail::LightmapMeshes::write(document, *meshes, *objects, lightmaps.corner_uvs, *parts);
    if (!written) return written.error();
    const uint32_t first_texture =
        lightmaps.pages.empty() ? kNoIndex : add_page_textures(lightmaps, *parts);
    detail::LightmapNodes writer(document, *parts, *written, {first_texture, lightmaps.intensity});
    for (const detail::LightmapObject& object : *objects) {
        if (auto status = writer.write(object); !status) return status.error();
    }
    for (const char* name : {"EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression"})
        parts->drop_unused_extension(name);
    return parts->glb();
}

}  // namespace

Result<std::vector<std::byte>> make_lightmap_glb(const std::string& path,
                                                 const GltfLightmaps& lightmaps,
                                                 const SceneReading& reading) {
    return detail::rewrite_gltf(path, reading, [&](const detail::GltfDocument& document) {
        return lightmapped(document, lightmaps);
    });
}

}  // namespace tetralight
