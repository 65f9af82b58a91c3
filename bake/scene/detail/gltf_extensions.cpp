// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_extensions.h>

#include <cmath>
#include <limits>

namespace tetralight::detail {
namespace {

glm::dvec2 vec2_at(const tinygltf::Value& object, const char* key, glm::dvec2 otherwise) {
    if (!object.Has(key)) return otherwise;
    const tinygltf::Value& array = object.Get(key);
    return {array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble()};
}

/// T · R · S of KHR_texture_transform. Texture coordinates run downwards, so that its
/// counter-clockwise rotation has the sines of a clockwise one.
glm::mat3 texture_matrix(const tinygltf::Value& transform) {
    const glm::dvec2 offset = vec2_at(transform, "offset", glm::dvec2(0.0));
    const glm::dvec2 scale = vec2_at(transform, "scale", glm::dvec2(1.0));
    const double rotation = number_at(transform, "rotation", 0.0);
    const double cosine = std::cos(rotation);
    const double sine = std::sin(rotation);
    return {glm::vec3(cosine * scale.x, -sine * scale.x, 0.0),
            glm::vec3(sine * scale.y, cosine * scale.y, 0.0), glm::vec3(offset, 1.0)};
}

/// `Info` is one of the classes that tinygltf has for textures of materials.
template <class Info>
TextureUse texture_use(const Info& info) {
    TextureUse use;
    use.texture = index_from(info.index);
    use.uv_set = static_cast<uint32_t>(info.texCoord);
    const auto* transform = find_extension(info.extensions, "KHR_texture_transform");
    if (transform == nullptr) return use;
    use.image_from_mesh = texture_matrix(*transform);
    if (transform->Has("texCoord")) {
        use.uv_set = static_cast<uint32_t>(transform->Get("texCoord").GetNumberAsInt());
    }
    return use;
}

}  // namespace

uint32_t index_from(int index) {
    return index < 0 ? kNoIndex : static_cast<uint32_t>(index);
}

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

std::optional<double> number_extra(const tinygltf::Value& extras, const char* key) {
    if (!extras.Has(key)) return std::nullopt;
    const tinygltf::Value& value = extras.Get(key);
    return value.IsNumber() ? value.GetNumberAsDouble() : std::numeric_limits<double>::quiet_NaN();
}

std::optional<std::string> string_extra(const tinygltf::Value& extras, const char* key) {
    if (!extras.Has(key)) return std::nullopt;
    const tinygltf::Value& value = extras.Get(key);
    return value.IsString() ? value.Get<std::string>() : std::string("(not a string)");
}

std::optional<bool> boolean_extra(const tinygltf::Value& extras, const char* key) {
    if (!extras.Has(key)) return std::nullopt;
    return extras.Get(key).Get<bool>();
}

std::optional<glm::dvec2> vec2_extra(const tinygltf::Value& extras, const char* key) {
    if (!extras.Has(key)) return std::nullopt;
    const tinygltf::Value& value = extras.Get(key);
    return glm::dvec2(value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble());
}

double number_at(const tinygltf::Value& object, const char* key, double otherwise) {
    return object.Has(key) ? object.Get(key).GetNumberAsDouble() : otherwise;
}

TextureUse texture_use_from(const tinygltf::TextureInfo& info) {
    return texture_use(info);
}

TextureUse texture_use_from(const tinygltf::NormalTextureInfo& info) {
    return texture_use(info);
}

std::optional<std::string> bake_emission_from(const tinygltf::Value& extras) {
    constexpr const char* kKey = "bake_emission";
    if (!extras.Has(kKey) || !extras.Get(kKey).IsBool()) return string_extra(extras, kKey);
    return extras.Get(kKey).Get<bool>() ? "baked" : "none";
}

std::optional<uint32_t> rendering_layers_extra(const tinygltf::Value& extras) {
    if (!extras.Has("rendering_layers")) return std::nullopt;
    const tinygltf::Value& layers = extras.Get("rendering_layers");
    uint32_t mask = 0;
    for (size_t i = 0; i < layers.ArrayLen(); ++i) {
        mask |= uint32_t{1} << layers.Get(static_cast<int>(i)).GetNumberAsInt();
    }
    return mask;
}

std::optional<GltfAdjustment> adjustment_from(const tinygltf::Value& extras) {
    if (!extras.Has("probe_adjustment")) return std::nullopt;
    const tinygltf::Value& value = extras.Get("probe_adjustment");
    GltfAdjustment result;
    result.shape = string_extra(value, "shape").value_or("");
    if (value.Has("size")) {
        const tinygltf::Value& size = value.Get("size");
        result.size = {size.Get(0).GetNumberAsDouble(), size.Get(1).GetNumberAsDouble(),
                       size.Get(2).GetNumberAsDouble()};
    }
    result.radius = number_extra(value, "radius");
    result.forbid = boolean_extra(value, "forbid");
    result.spacing = number_extra(value, "spacing");
    result.validity = number_extra(value, "validity");
    result.intensity = number_extra(value, "intensity");
    result.rendering_layers = rendering_layers_extra(value);
    return result;
}

GltfLightExtras light_extras_from(const tinygltf::Value& extras) {
    GltfLightExtras result;
    result.mode = string_extra(extras, "mode");
    result.falloff = string_extra(extras, "falloff");
    result.shape = string_extra(extras, "shape");
    result.indirect_multiplier = number_extra(extras, "indirect_multiplier");
    result.radius = number_extra(extras, "radius");
    result.angle_degrees = number_extra(extras, "angle");
    result.width = number_extra(extras, "width");
    result.height = number_extra(extras, "height");
    return result;
}

}  // namespace tetralight::detail
