// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/exporter_habits.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <tetralight/bake/scene/read_gltf.h>
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

/// True if the intensity is that of a number of watts that a 32-bit float holds, in lumens: Blender
/// computes with doubles, and writes all their digits.
bool is_in_lumens_of_watts(const GltfLight& light) {
    constexpr double kRounding = 2e-15;  // of three operations
    const double sides = light.type == "directional" ? 1.0 : 4.0 * std::numbers::pi;
    const double watts = light.intensity * sides / kLumensPerWatt;
    if (!(watts > 0.0) || watts > std::numeric_limits<float>::max()) return false;
    return std::abs(static_cast<float>(watts) - watts) <= kRounding * watts;
}

/// True if all lights of the file are in lumens of watts. One sun in 683 is by chance: a sun counts
/// as evidence only if Blender wrote it, and if it is not a dim one.
bool has_lumens_of_watts(const GltfDocument& document) {
    constexpr double kDimSun = 68.0;  // 0.1 W/m²
    const bool is_of_blender = document.generator.find("Blender") != std::string::npos;
    bool is_found = false;
    for (const GltfLight& light : document.lights) {
        if (light.intensity == 0.0) continue;
        if (!is_in_lumens_of_watts(light)) return false;
        const bool is_sun = light.type == "directional";
        is_found = is_found || !is_sun || (is_of_blender && light.intensity >= kDimSun);
    }
    return is_found;
}

/// True for a sun of 1 to 10 W/m² in lux: no daylight, and bright beside emission near 1.
bool is_bright_sun(const Light& light) {
    constexpr float kFewest = 600.0f, kMost = 7000.0f;
    const float intensity = largest(light.intensity);
    return light.type == LightType::Directional && intensity >= kFewest && intensity <= kMost;
}

/// The light that is an example of lumens of watts; none if lights are in another unit.
std::optional<size_t> light_in_lumens(const GltfDocument& document, const Scene& scene,
                                      float emission) {
    constexpr float kDimEmission = 100.0f;  // strengths of emission and skies are near 1 in watts
    const auto intensity_of = [](const Light& light) { return largest(light.intensity); };
    auto found = std::ranges::max_element(scene.lights, {}, intensity_of);
    if (found == scene.lights.end() || !(intensity_of(*found) > 0.0f)) return std::nullopt;
    if (!has_lumens_of_watts(document)) {
        if (!(emission > 0.0f) || emission > kDimEmission) return std::nullopt;
        found = std::ranges::find_if(scene.lights, is_bright_sun);
        if (found == scene.lights.end()) return std::nullopt;
    }
    return static_cast<size_t>(found - scene.lights.begin());
}

}  // namespace

void add_light_unit(const GltfDocument& document, const Scene& scene, bool has_other_sky,
                    PartList& parts) {
    const float emission = brightest_emission(scene);
    const bool has_sky = has_other_sky || !scene.environment.image.pixels.empty();
    if (!(emission > 0.0f) && !has_sky) return;
    const auto index = light_in_lumens(document, scene, emission);
    if (!index) return;
    const Light& light = scene.lights[*index];
    const bool is_sun = light.type == LightType::Directional;
    ScenePart part;
    part.use = PartUse::Approximated;
    part.name = "units of lights";
    part.note = str_cat(is_sun ? "the sun is " : "the light is ", largest(light.intensity),
                        is_sun ? " lux" : " candela", " beside ",
                        emission > 0.0f ? str_cat("emission of ", emission) : std::string("a sky"),
                        ", as exporters write it that count a watt as 683 lumens");
    part.remedy = "--light-unit watt divides lights by 683";
    part.changes_light = true;
    parts.add(part, str_cat("\"", scene.light_names[*index], "\""));
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
