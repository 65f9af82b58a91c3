// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lightmap_scene.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <string>

#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/lightmap/sample_lightmap.h>
#include <tetralight/probes/content_hash.h>

namespace tetralight {
namespace {

Error misfit(const std::string& message) {
    return {ErrorCode::InvalidArgument, "scene", "", message};
}

/// What is wrong with the lightmap of one instance; empty if it fits.
std::string misfit_of(size_t triangle_count, uint64_t key, const LightmapsView& lightmaps,
                      const LightmapRectangle& rectangle) {
    if (rectangle.mesh >= lightmaps.meshes.size()) return "its UVs are not stored in the lightmaps";
    const LightmapMesh& stored = lightmaps.meshes[rectangle.mesh];
    if (stored.triangle_count != triangle_count) {
        return str_cat("it has ", triangle_count, " triangles, and had ", stored.triangle_count,
                       " when the lightmaps were baked");
    }
    if (stored.geometry_key != key)
        return "its positions or indices have changed since the lightmaps were baked";
    return "";
}

}  // namespace

uint64_t geometry_key(const Mesh& mesh) {
    ContentHash hash;
    hash.add(mesh.positions);
    hash.add(mesh.indices);
    return hash.value();
}

Status check_lightmap_scene(const LightmapsView& lightmaps, const Scene& scene) {
    if (scene.instances.size() != lightmaps.rectangles.size()) {
        return misfit(str_cat("the scene has ", scene.instances.size(),
                              " instances, the lightmaps have ", lightmaps.rectangles.size()));
    }
    std::vector<uint64_t> keys;
    for (const Mesh& mesh : scene.meshes) keys.push_back(geometry_key(mesh));
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const LightmapRectangle& rectangle = lightmaps.rectangles[i];
        if (rectangle.page == kNoIndex) continue;
        const MeshInstance& instance = scene.instances[i];
        const size_t triangle_count = scene.meshes[instance.mesh].indices.size() / 3;
        const std::string problem =
            misfit_of(triangle_count, keys[instance.mesh], lightmaps, rectangle);
        if (problem.empty()) continue;
        return misfit(str_cat("the lightmaps do not fit the object \"", instance.name,
                              "\" (instance ", i, "): ", problem));
    }
    return Ok{};
}

std::vector<glm::vec2> unit_uvs(const PackedCharts& charts) {
    const glm::vec2 size(std::max(charts.width, 1u), std::max(charts.height, 1u));
    std::vector<glm::vec2> uvs;
    for (const glm::vec2& uv : charts.corner_uvs) uvs.push_back(uv / size);
    return uvs;
}

LightmapRectangle rectangle_of(const LightmapLayout& layout, const LightmapPlace& place) {
    LightmapRectangle rectangle;
    if (!place.has_lightmap()) return rectangle;
    const PackedCharts& charts = layout.packings[place.packing].charts;
    rectangle.page = place.corner.page;
    rectangle.x = place.corner.x;
    rectangle.y = place.corner.y;
    rectangle.width = charts.width;
    rectangle.height = charts.height;
    rectangle.mesh = place.packing;
    set_page_transform(rectangle, layout.page_size);
    return rectangle;
}

LightmapLayout layout_of(const LightmapsView& lightmaps, const Scene& scene) {
    LightmapLayout layout;
    layout.page_size = lightmaps.info.page_size;
    layout.page_count = lightmaps.info.page_count;
    layout.texels_per_meter = double{lightmaps.info.texels_per_meter};
    layout.packings.resize(lightmaps.meshes.size());
    for (size_t i = 0; i < lightmaps.rectangles.size(); ++i) {
        const LightmapRectangle& rectangle = lightmaps.rectangles[i];
        LightmapPlace& place = layout.places.emplace_back();
        if (rectangle.page == kNoIndex) continue;
        place = {rectangle.mesh, {rectangle.page, rectangle.x, rectangle.y}};
        LightmapPacking& packing = layout.packings[rectangle.mesh];
        if (!packing.charts.corner_uvs.empty()) continue;
        packing.mesh = scene.instances[i].mesh;
        packing.charts.width = rectangle.width;
        packing.charts.height = rectangle.height;
        const LightmapMesh& mesh = lightmaps.meshes[rectangle.mesh];
        const glm::vec2 size(rectangle.width, rectangle.height);
        const auto uvs =
            lightmaps.corner_uvs.subspan(mesh.first_corner, 3 * size_t{mesh.triangle_count});
        for (const glm::vec2& uv : uvs) packing.charts.corner_uvs.push_back(uv * size);
    }
    return layout;
}

glm::vec2 page_uv_of(const LightmapsView& lightmaps, const Scene& scene, uint32_t instance,
                     uint32_t triangle, const glm::dvec3& position) {
    const MeshInstance& placed = scene.instances[instance];
    const Mesh& mesh = scene.meshes[placed.mesh];
    const LightmapRectangle& place = lightmaps.rectangles[instance];
    std::array<glm::dvec3, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
        const uint32_t vertex = mesh.indices[3 * size_t{triangle} + i];
        corners[i] = world_position(placed, mesh.positions[vertex]);
    }
    const glm::dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
    const glm::dvec3 normal = glm::cross(u, v), w = position - corners[0];
    const double square = glm::dot(normal, normal);
    const double b = square > 0.0 ? glm::dot(glm::cross(w, v), normal) / square : 0.0;
    const double c = square > 0.0 ? glm::dot(glm::cross(u, w), normal) / square : 0.0;
    const uint32_t first = lightmaps.meshes[place.mesh].first_corner + 3 * triangle;
    const glm::dvec2 uv = (1.0 - b - c) * glm::dvec2(lightmaps.corner_uvs[first]) +
                          b * glm::dvec2(lightmaps.corner_uvs[first + 1]) +
                          c * glm::dvec2(lightmaps.corner_uvs[first + 2]);
    return page_uv(place, glm::vec2(uv));
}

}  // namespace tetralight
