// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_textures.h>

#include <utility>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_uri.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr uint32_t kClampToEdge = 33071;
constexpr uint32_t kMirroredRepeat = 33648;
constexpr uint32_t kRepeat = 10497;

Result<TextureWrap> wrap_from(uint32_t code, const char* name) {
    switch (code) {
        case kRepeat:
            return TextureWrap::Repeat;
        case kMirroredRepeat:
            return TextureWrap::MirroredRepeat;
        case kClampToEdge:
            return TextureWrap::ClampToEdge;
        default:
            return Error{ErrorCode::Corrupt, str_cat(".", name), str_cat(code),
                         str_cat(name, " ", code, " is not a wrap mode")};
    }
}

Status set_wrap_modes(const GltfDocument& document, uint32_t sampler_index, Texture& texture) {
    if (sampler_index == kNoIndex) return Ok{};
    const GltfSampler& sampler = document.samplers[sampler_index];
    const auto wrap_u = wrap_from(sampler.wrap_s, "wrapS");
    if (!wrap_u) return in_element(wrap_u.error(), "samplers", sampler_index, "");
    const auto wrap_v = wrap_from(sampler.wrap_t, "wrapT");
    if (!wrap_v) return in_element(wrap_v.error(), "samplers", sampler_index, "");
    texture.wrap_u = *wrap_u;
    texture.wrap_v = *wrap_v;
    return Ok{};
}

std::string name_of(const GltfTexture& texture, const GltfImage& image) {
    if (!texture.name.empty()) return texture.name;
    return image.name.empty() && !is_data_uri(image.uri) ? image.uri : image.name;
}

}  // namespace

Result<uint32_t> GltfTextureReader::read(uint32_t gltf_texture) {
    const GltfTexture& source = document_.textures[gltf_texture];
    const std::string place = gltf_place("texture", gltf_texture, source.name);
    if (source.image == kNoIndex && source.basisu_image != kNoIndex) {
        return Error{ErrorCode::Unsupported, str_cat("textures[", gltf_texture, "].source"), "",
                     place +
                         ": has only a Basis Universal image (KHR_texture_basisu), which is not "
                         "read; `gltf-transform ktxdecompress` makes it a PNG image"};
    }
    if (source.image == kNoIndex) {
        parts.add_left_out("textures without image", "have no PNG, JPEG or WebP image; left out",
                           true, place);
        return kNoIndex;
    }
    auto texture = find_or_decode(source);
    if (!texture) {
        return in_member(texture.error().in(place), str_cat("textures[", gltf_texture, "]"));
    }
    return texture;
}

Result<uint32_t> GltfTextureReader::find_or_decode(const GltfTexture& source) {
    Texture texture;
    const auto wrap = set_wrap_modes(document_, source.sampler, texture);
    if (!wrap) return wrap.error();
    const uint32_t image_index = images_.first_alike(source.image);
    const std::array<uint32_t, 3> key = {image_index, static_cast<uint32_t>(texture.wrap_u),
                                         static_cast<uint32_t>(texture.wrap_v)};
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
    auto image = images_.take(image_index);
    if (!image) return image.error();
    texture.name = name_of(source, document_.images[source.image]);
    texture.image = std::move(*image);
    const auto index = static_cast<uint32_t>(textures.size());
    textures.push_back(std::move(texture));
    known_.emplace(key, index);
    return index;
}

}  // namespace tetralight::detail
