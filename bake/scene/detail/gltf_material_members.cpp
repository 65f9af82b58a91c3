// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_material_members.h>

#include <cmath>
#include <string>
#include <string_view>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr uint32_t kUvSetCount = 2;

std::string last_part(const char* path) {
    return path + std::string_view(path).rfind('.') + 1;
}

bool is_finite(const glm::mat3& matrix) {
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            if (!std::isfinite(matrix[column][row])) return false;
        }
    }
    return true;
}

template <class To, class From>
Result<To> factors_from(const From& values, const char* path) {
    To factors{};
    for (int channel = 0; channel < To::length(); ++channel) {
        const auto factor = read_factor(values[channel], path);
        if (!factor) return factor.error();
        factors[channel] = *factor;
    }
    return factors;
}

}  // namespace

Result<float> read_factor(double value, const char* path) {
    if (value >= 0.0 && value <= 1.0) return static_cast<float>(value);
    return Error{ErrorCode::Corrupt, path, str_cat(value),
                 str_cat(last_part(path), " ", value, " is not in 0 to 1")};
}

Result<glm::vec3> read_factors(const glm::dvec3& values, const char* path) {
    return factors_from<glm::vec3>(values, path);
}

Result<glm::vec4> read_factors(const glm::dvec4& values, const char* path) {
    return factors_from<glm::vec4>(values, path);
}

Result<TextureUse> read_texture_use(TextureUse use, const char* path, GltfTextureReader& reader) {
    if (use.texture == kNoIndex) return use;
    const std::string name = last_part(path);
    if (use.uv_set >= kUvSetCount) {
        return Error{ErrorCode::Unsupported, str_cat(path, ".texCoord"), str_cat(use.uv_set),
                     str_cat(name, ": texCoord ", use.uv_set, " is not supported (0 and 1 are)")};
    }
    if (!is_finite(use.image_from_mesh)) {
        return Error{ErrorCode::Corrupt, str_cat(path, ".extensions.KHR_texture_transform"), "",
                     str_cat(name, ": KHR_texture_transform is not finite")};
    }
    const auto texture = reader.read(use.texture);
    if (!texture) return texture.error().in(name);
    use.texture = *texture;
    return use;
}

}  // namespace tetralight::detail
