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

#include <tetralight/bake/scene/length_unit.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bake/scene/scene_bounds.h>
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

bool fades_over_distance(const Light& light) {
    return light.type != LightType::Directional;
}

/// The sizes of all objects, metres, ascending.
std::vector<double> object_sizes(const Scene& scene) {
    const std::vector<float> mesh_size = mesh_sizes(scene);
    std::vector<double> sizes;
    for (const MeshInstance& instance : scene.instances) {
        sizes.push_back(mesh_size[instance.mesh] * largest_scale(instance.world_from_mesh));
    }
    std::ranges::sort(sizes);
    return sizes;
}

constexpr double kTooLarge = 50.0;     // metres, for most objects
constexpr double kDistantLamp = 20.0;  // metres from any surface

/// True if a triangle's box is nearer to a position than that. Boxes hold their triangles: no
/// surface is nearer than its box.
bool is_near_surface(const Scene& scene, const glm::dvec3& position, double distance) {
    for (const MeshInstance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (size_t corner = 0; corner + 2 < mesh.indices.size(); corner += 3) {
            auto box = WorldBox::empty();
            for (size_t k = 0; k < 3; ++k) {
                const glm::vec3& vertex = mesh.positions[mesh.indices[corner + k]];
                box = union_of(box, world_position(instance, vertex));
            }
            const glm::dvec3 nearest = glm::clamp(position, box.min, box.max);
            if (glm::distance(nearest, position) < distance) return true;
        }
    }
    return false;
}

/// True if there are lamps in a scene of 500 m or more, and none of them is near a surface: lamps
/// of rooms and streets are. Looks at the first few.
bool has_distant_lamps(const Scene& scene) {
    constexpr size_t kMostLamps = 8;
    if (length_unit_hint(scene).empty()) return false;
    size_t lamps = 0;
    for (const Light& light : scene.lights) {
        if (!fades_over_distance(light) || lamps == kMostLamps) continue;
        if (is_near_surface(scene, glm::dvec3(light.position), kDistantLamp)) return false;
        ++lamps;
    }
    return lamps > 0;
}

}  // namespace

void add_light_unit(const GltfDocument& document, const Scene& scene, bool has_other_sky,
                    PartList& parts) {
    const float emission = brightest_emission(scene);
    const bool has_sky = has_other_sky || !scene.environment.image.pixels.empty();
    const auto index = light_in_lumens(document, scene, emission);
    if (!index) return;
    const Light& light = scene.lights[*index];
    const bool is_sun = light.type == LightType::Directional;
    ScenePart part;
    part.use = PartUse::Approximated;
    part.name = "units of lights";
    std::string others;
    if (emission > 0.0f) {
        others = str_cat(" beside emission of ", emission);
    } else if (has_sky) {
        others = " beside a sky";
    }
    part.note = str_cat(is_sun ? "the sun is " : "the light is ", largest(light.intensity),
                        is_sun ? " lux" : " candela", others,
                        ", as exporters write it that count a watt as 683 lumens");
    part.remedy = "--light-unit watt divides lights by 683";
    part.changes_light = !others.empty();
    parts.add(part, str_cat("\"", scene.light_names[*index], "\""));
}

void add_length_unit(const Scene& scene, PartList& parts) {
    const std::vector<double> sizes = object_sizes(scene);
    if (sizes.empty()) return;
    const double size = sizes[sizes.size() / 4];
    constexpr size_t kFewest = 3;  // one large object may be a landscape
    std::string reason;
    if (size >= kTooLarge && sizes.size() >= kFewest) {
        reason = str_cat("the boxes of three of four objects have diagonals of more than ",
                         static_cast<int64_t>(size), " m");
    } else if (sizes.front() >= kTooLarge && has_distant_lamps(scene)) {
        reason = str_cat("the boxes of all objects have diagonals of more than ",
                         static_cast<int64_t>(sizes.front()), " m, and all lamps are farther than ",
                         kDistantLamp, " m from them");
    }
    if (reason.empty()) return;
    ScenePart part;
    part.use = PartUse::Approximated;
    part.name = "units of length";
    part.note = reason + "; metres are assumed";
    part.remedy = "if the unit is a centimetre, scale the scene by 0.01";
    part.changes_light = std::ranges::any_of(scene.lights, fades_over_distance);
    parts.add(part, "the scene");
}

}  // namespace tetralight::detail
