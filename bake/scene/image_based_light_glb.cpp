// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/image_based_light_glb.h>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_parts.h>
#include <tetralight/bake/scene/detail/json_members.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/reflection/cube.h>

namespace tetralight {
namespace {

using detail::GltfJson;

constexpr const char* kExtension = "EXT_lights_image_based";

/// Adds the images of a light; returns their indices, six for each level.
GltfJson add_images(const GltfImageBasedLight& light, detail::GltfParts& parts) {
    constexpr const char* kFaces[] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
    GltfJson levels = GltfJson::array();
    for (size_t level = 0; level < light.levels.size(); ++level) {
        GltfJson faces = GltfJson::array();
        for (size_t face = 0; face < 6; ++face) {
            const uint32_t view = parts.add_view(light.levels[level][face]);
            faces.push_back(
                parts.add("images", {{"name", str_cat(light.name, ' ', level, ' ', kFaces[face])},
                                     {"mimeType", "image/png"},
                                     {"bufferView", view}}));
        }
        levels.push_back(std::move(faces));
    }
    return levels;
}

GltfJson light_json(const GltfImageBasedLight& light, GltfJson images) {
    GltfJson coefficients = GltfJson::array();
    for (const glm::vec3& c : light.irradiance_coefficients)
        coefficients.push_back({c.x, c.y, c.z});
    GltfJson json = {{"name", light.name},
                     {"intensity", light.intensity},
                     {"irradianceCoefficients", std::move(coefficients)},
                     {"specularImageSize", light.size},
                     {"specularImages", std::move(images)}};
    if (!light.is_sky) json["extras"] = {{"sky", false}};
    return json;
}

/// `object[name]`, which becomes `otherwise` if it is not there. Returns corrupt if it is of
/// another type.
Result<GltfJson*> member(GltfJson& object, const char* name, const GltfJson& otherwise) {
    if (!object.contains(name)) object[name] = otherwise;
    GltfJson& value = object[name];
    if (value.type() == otherwise.type()) return &value;
    return detail::wrong_type(value, name, otherwise.is_array() ? "an array" : "an object");
}

/// The extension of the document or of a scene.
Result<GltfJson*> extension_of(GltfJson& element) {
    const auto extensions = member(element, "extensions", GltfJson::object());
    if (!extensions) return extensions;
    const auto extension = member(**extensions, kExtension, GltfJson::object());
    if (!extension) return detail::in_member(extension.error(), ".extensions");
    return extension;
}

/// Adds a light to the document; returns its index.
Result<size_t> add_light(GltfJson& document, GltfJson light) {
    const auto extension = extension_of(document);
    if (!extension) return detail::in_member(extension.error(), "");
    const auto lights = member(**extension, "lights", GltfJson::array());
    if (!lights) return detail::in_member(lights.error(), str_cat("extensions.", kExtension));
    (*lights)->push_back(std::move(light));
    return (*lights)->size() - 1;
}

Status use_light(GltfJson& document, uint32_t scene, size_t light) {
    const auto extension = extension_of(document["scenes"][scene]);
    if (!extension) return detail::in_element(extension.error(), "scenes", scene, "");
    (**extension)["light"] = light;
    return Ok{};
}

/// The file with a light that its scene uses.
Result<std::vector<std::byte>> lit_scene(detail::GltfParts& parts, uint32_t scene,
                                         const GltfImageBasedLight& light) {
    const auto index = add_light(parts.json, light_json(light, add_images(light, parts)));
    if (!index) return index.error();
    if (auto status = use_light(parts.json, scene, *index); !status) return status.error();
    parts.use_extension(kExtension);
    return parts.glb();
}

Result<std::vector<std::byte>> lit(const detail::GltfDocument& document,
                                   const GltfImageBasedLight& light) {
    if (!document.scene_roots) {
        return Error{ErrorCode::InvalidArgument, "scenes", "",
                     "has no scene that could use an image-based light"};
    }
    auto parts = detail::GltfParts::open(document);
    if (!parts) return parts.error();
    return lit_scene(*parts, document.scene, light);
}

}  // namespace

Result<std::vector<std::byte>> make_image_based_light_glb(const std::string& path,
                                                          const GltfImageBasedLight& light) {
    return detail::rewrite_gltf(
        path, {}, [&](const detail::GltfDocument& document) { return lit(document, light); });
}

Result<std::vector<std::byte>> make_image_based_light_glb(const GltfImageBasedLight& light) {
    detail::GltfParts parts;
    parts.json = {{"asset", {{"version", "2.0"}, {"generator", "Tetralight"}}},
                  {"scene", 0},
                  {"scenes", GltfJson::array({GltfJson::object()})}};
    return lit_scene(parts, 0, light);
}

glm::vec3 image_based_light_direction(uint32_t face, uint32_t x, uint32_t y,
                                      uint32_t size) noexcept {
    const uint32_t world_face = face < 2 ? 1 - face : face;
    return cube_direction(CubeTexel{world_face, size - 1 - x, size - 1 - y}, size);
}

}  // namespace tetralight
