// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/write_lightmap_glb.h>

#include <algorithm>
#include <span>
#include <utility>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/bake/scene/lightmap_glb.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/lightmap_images.h>
#include <tetralight/pipeline/lightmap_scene.h>

namespace tetralight {
namespace {

GltfLightmapPlace gltf_place_of(const LightmapRectangle& rectangle, uint32_t uvs) {
    return {uvs, rectangle.page, rectangle.scale, rectangle.offset};
}

Status write_bytes(const std::string& path, const Result<std::vector<std::byte>>& bytes) {
    if (!bytes) return bytes.error();
    return write_file(path, *bytes);
}

}  // namespace

Status write_unwrapped_glb(const std::string& path, const std::string& scene_path,
                           const LightmapLayout& layout, const SceneReading& reading) {
    std::vector<std::vector<glm::vec2>> uvs;
    GltfLightmaps lightmaps;
    for (const LightmapPacking& packing : layout.packings) uvs.push_back(unit_uvs(packing.charts));
    lightmaps.corner_uvs.assign(uvs.begin(), uvs.end());
    for (const LightmapPlace& place : layout.places) {
        lightmaps.places.push_back(gltf_place_of(rectangle_of(layout, place), place.packing));
    }
    return write_bytes(path, make_lightmap_glb(scene_path, lightmaps, reading));
}

Status write_lightmap_glb(const std::string& path, const std::string& scene_path,
                          const Scene& scene, const LightmapsView& lightmaps,
                          const SceneReading& reading) {
    if (auto status = check_lightmap_scene(lightmaps, scene); !status) return status;
    const auto irradiance = map_values(lightmaps, LightmapMap::Irradiance);
    const float largest = largest_value(*irradiance);
    const float range = largest > 0.0f ? largest : 1.0f;
    GltfLightmaps gltf;
    gltf.intensity = double{range} / kThirdRoomRange;
    for (const LightmapMesh& mesh : lightmaps.meshes) {
        gltf.corner_uvs.push_back(
            lightmaps.corner_uvs.subspan(mesh.first_corner, size_t{3} * mesh.triangle_count));
    }
    for (const LightmapRectangle& rectangle : lightmaps.rectangles) {
        const bool has_lightmap = rectangle.page != kNoIndex;
        gltf.places.push_back(gltf_place_of(rectangle, has_lightmap ? rectangle.mesh : kNoIndex));
    }
    for (uint32_t page = 0; page < lightmaps.info.page_count; ++page) {
        auto image =
            encode_png(encode_rgbm(page_colors(*irradiance, page), range, RgbmCurve::ThirdRoom));
        if (!image) return image.error();
        gltf.pages.push_back(std::move(*image));
    }
    return write_bytes(path, make_lightmap_glb(scene_path, gltf, reading));
}

}  // namespace tetralight
