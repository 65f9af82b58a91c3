// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/exporter_habits.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include <tetralight/bake/scene/surface_color.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

float largest(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

/// The brightest emission of materials and sky.
float brightest_emission(const Scene& scene) {
    float radiance =
        scene.environment.image.pixels.empty() ? largest(scene.environment.radiance) : 0.0f;
    for (const Material& material : scene.materials) {
        if (!material.is_unlit) radiance = std::max(radiance, largest(material.emission));
    }
    return radiance;
}

/// The diagonal of each mesh's box, in its own frame.
std::vector<float> mesh_sizes(const Scene& scene) {
    std::vector<float> sizes;
    for (const Mesh& mesh : scene.meshes) {
        glm::vec3 low(std::numeric_limits<float>::max());
        glm::vec3 high(std::numeric_limits<float>::lowest());
        for (const glm::vec3& position : mesh.positions) {
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
        sizes.push_back(mesh.positions.empty() ? 0.0f : glm::length(high - low));
    }
    return sizes;
}

double largest_scale(const glm::dmat4& transform) {
    return std::max({glm::length(glm::dvec3(transform[0])), glm::length(glm::dvec3(transform[1])),
                     glm::length(glm::dvec3(transform[2]))});
}

}  // namespace

void add_light_unit(const Scene& scene, PartList& parts) {
    // 1 W/m² is 683 lux in these files; strengths of suns, emission and skies are near 1 there.
    constexpr float kBrightSun = 600.0f;
    constexpr float kDimEmission = 100.0f;
    const float emission = brightest_emission(scene);
    if (!(emission > 0.0f) || emission > kDimEmission) return;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        const float intensity = largest(light.intensity);
        if (light.type != LightType::Directional || intensity < kBrightSun) continue;
        ScenePart part;
        part.use = PartUse::Approximated;
        part.name = "units of lights";
        part.note = str_cat("the sun is ", intensity, " lux beside emission of ", emission,
                            ", as exporters write it that count a watt as 683 lumens");
        part.remedy = "--light-unit watt divides lights by 683";
        part.changes_light = true;
        parts.add(part, str_cat("\"", scene.light_names[i], "\""));
        return;
    }
}

void add_length_unit(const Scene& scene, PartList& parts) {
    constexpr size_t kFewest = 3;       // one large object may be a landscape
    constexpr double kTooLarge = 50.0;  // metres, for most objects
    const std::vector<float> mesh_size = mesh_sizes(scene);
    std::vector<double> sizes;
    for (const MeshInstance& instance : scene.instances) {
        sizes.push_back(mesh_size[instance.mesh] * largest_scale(instance.world_from_mesh));
    }
    if (sizes.size() < kFewest) return;
    const auto quarter = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 4);
    std::ranges::nth_element(sizes, quarter);
    if (*quarter < kTooLarge) return;
    ScenePart part;
    part.use = PartUse::Approximated;
    part.name = "units of length";
    part.note = str_cat("three of four objects are larger than ", static_cast<int64_t>(*quarter),
                        " m; lights fade over distance in metres");
    part.remedy = "if the unit is a centimetre, scale the scene by 0.01";
    part.changes_light = true;
    parts.add(part, "the scene");
}

}  // namespace tetralight::detail
