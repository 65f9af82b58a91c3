// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_members.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include <tetralight/bake/scene/detail/gltf_rules.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;

/// T · R · S of KHR_texture_transform. Texture coordinates run downwards, so that its
/// counter-clockwise rotation has the sines of a clockwise one.
glm::mat3 texture_matrix(const json& transform) {
    const auto vec2_at = [&](std::string_view key, double otherwise) {
        const auto numbers = numbers_at(transform, key);
        return numbers.empty() ? glm::dvec2(otherwise) : glm::dvec2(numbers[0], numbers[1]);
    };
    const glm::dvec2 offset = vec2_at("offset", 0.0);
    const glm::dvec2 scale = vec2_at("scale", 1.0);
    const double rotation = number_at(transform, "rotation", 0.0);
    const double cosine = std::cos(rotation);
    const double sine = std::sin(rotation);
    return {glm::vec3(cosine * scale.x, -sine * scale.x, 0.0),
            glm::vec3(sine * scale.y, cosine * scale.y, 0.0), glm::vec3(offset, 1.0)};
}

}  // namespace

void for_each_element(
    const json& document,
    const std::function<void(const GltfSection&, const json&, const std::string&)>& visit) {
    for (const GltfSection& section : gltf_sections()) {
        const json& elements = array_at(document, section.path);
        for (size_t i = 0; i < elements.size(); ++i) {
            const json* name = find_json(elements[i], "name");
            const bool is_named = name != nullptr && name->is_string();
            visit(section, elements[i],
                  gltf_place(section.element, i, is_named ? name->get<std::string>() : ""));
        }
    }
}

const json& array_at(const json& value, std::string_view path) {
    static const json kEmpty = json::array();
    const json* found = find_json(value, path);
    return found == nullptr ? kEmpty : *found;
}

uint32_t index_at(const json& value, std::string_view path) {
    const json* found = find_json(value, path);
    return found == nullptr ? kNoIndex : found->get<uint32_t>();
}

std::vector<uint32_t> indices_at(const json& value, std::string_view path) {
    const json* found = find_json(value, path);
    return found == nullptr ? std::vector<uint32_t>() : found->get<std::vector<uint32_t>>();
}

std::map<std::string, uint32_t> index_map_at(const json& value, std::string_view path) {
    std::map<std::string, uint32_t> map;
    const json* found = find_json(value, path);
    if (found == nullptr) return map;
    for (const auto& [name, index] : found->items()) map[name] = index.get<uint32_t>();
    return map;
}

uint64_t size_at(const json& value, std::string_view path, uint64_t otherwise) {
    const json* found = find_json(value, path);
    return found == nullptr ? otherwise : found->get<uint64_t>();
}

double number_at(const json& value, std::string_view path, double otherwise) {
    const json* found = find_json(value, path);
    return found == nullptr ? otherwise : found->get<double>();
}

std::vector<double> numbers_at(const json& value, std::string_view path) {
    const json* found = find_json(value, path);
    return found == nullptr ? std::vector<double>() : found->get<std::vector<double>>();
}

std::string string_at(const json& value, std::string_view path, std::string_view otherwise) {
    const json* found = find_json(value, path);
    return found == nullptr ? std::string(otherwise) : found->get<std::string>();
}

std::optional<bool> boolean_at(const json& value, std::string_view path) {
    const json* found = find_json(value, path);
    if (found == nullptr) return std::nullopt;
    return found->is_boolean() ? found->get<bool>() : found->get<double>() != 0.0;
}

glm::dvec3 vec3_at(const json& value, std::string_view path, const glm::dvec3& otherwise) {
    const auto numbers = numbers_at(value, path);
    return numbers.empty() ? otherwise : glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

glm::dvec4 vec4_at(const json& value, std::string_view path, const glm::dvec4& otherwise) {
    const auto numbers = numbers_at(value, path);
    return numbers.empty() ? otherwise : glm::dvec4(numbers[0], numbers[1], numbers[2], numbers[3]);
}

TextureUse texture_use_at(const json& material, std::string_view path) {
    TextureUse use;
    const json* info = find_json(material, path);
    if (info == nullptr) return use;
    use.texture = index_at(*info, "index");
    use.uv_set = static_cast<uint32_t>(size_at(*info, "texCoord", 0));
    const json* transform = find_json(*info, "extensions/KHR_texture_transform");
    if (transform == nullptr) return use;
    use.image_from_mesh = texture_matrix(*transform);
    use.uv_set = static_cast<uint32_t>(size_at(*transform, "texCoord", use.uv_set));
    return use;
}

}  // namespace tetralight::detail
