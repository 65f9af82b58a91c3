// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_images.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <future>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_uri.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using Bytes = std::span<const std::byte>;

constexpr uint32_t kRepeatCode = 10497;

/// Reads something of the bytes of an image file; `place` is what messages call the image.
template <class T>
Result<T> from_file(const GltfDocument& document, const GltfImage& image, const std::string& place,
                    Result<T> (*read)(Bytes bytes, const std::string& name)) {
    if (is_data_uri(image.uri)) {
        return Error{ErrorCode::Unsupported, ".uri", quoted_value(image.uri),
                     place + ": kind of data URI is not supported"};
    }
    if (image.uri.empty()) {
        return Error{ErrorCode::Corrupt, ".uri", "", place + ": has neither uri nor bufferView"};
    }
    const auto path = path_from_uri(image.uri, document.path);
    if (!path) return path.error().in(place);
    const auto file = MappedFile::open(*path);
    if (!file) {
        Error error = in_member(file.error().in(place), ".uri");
        error.value = quoted_value(image.uri);
        return error;
    }
    auto result = read(file->bytes(), str_cat(place, ": ", *path));
    if (!result) return in_member(result.error(), ".uri");
    return result;
}

/// Reads something of an image's bytes, wherever they are.
template <class T>
Result<T> from_image(const GltfDocument& document, uint32_t index,
                     Result<T> (*read)(Bytes bytes, const std::string& name)) {
    const GltfImage& image = document.images[index];
    const std::string place = gltf_place("image", index, image.name);
    Result<T> result = T();
    if (image.buffer_view != kNoIndex) {
        const GltfBufferView& view = document.buffer_views[image.buffer_view];
        const auto buffer = std::as_bytes(std::span(document.buffers[view.buffer]));
        result = read(buffer.subspan(view.byte_offset, view.byte_length), place);
    } else if (!image.encoded.empty()) {
        result = read(image.encoded, place);
    } else {
        result = from_file(document, image, place, read);
    }
    if (!result) return in_member(result.error(), str_cat("images[", index, "]"));
    return result;
}

/// Collects the uses of images by textures.
class ImageUses {
  public:
    explicit ImageUses(const GltfDocument& document) : document_(document) {}

    void add(const TextureUse& use) {
        if (use.texture == kNoIndex) return;
        const GltfTexture& texture = document_.textures[use.texture];
        if (texture.image == kNoIndex) return;
        GltfSampler sampler{kRepeatCode, kRepeatCode};
        if (texture.sampler != kNoIndex) sampler = document_.samplers[texture.sampler];
        uses_.insert({alike_[texture.image], sampler.wrap_s, sampler.wrap_t});
    }

    void append_to(std::vector<GltfImageUse>& uses) const {
        uses.insert(uses.end(), uses_.begin(), uses_.end());
    }

  private:
    const GltfDocument& document_;
    std::vector<uint32_t> alike_ = images_alike(document_);
    std::set<GltfImageUse> uses_;
};

/// What a material reflects.
void add_surface(const GltfMaterial& material, ImageUses& uses) {
    if (material.specular_glossiness && !material.is_unlit) {
        uses.add(material.specular_glossiness->diffuse_texture);
        uses.add(material.specular_glossiness->specular_glossiness_texture);
        return;
    }
    uses.add(material.base_color_texture);
    const bool uses_factors = material.metallic > 0.0 || material.roughness > 0.0;
    if (uses_factors && !material.is_unlit) uses.add(material.metallic_roughness_texture);
}

/// Calls `work(i)` once for each i < count on all processors. Where there are no more threads,
/// those that there are do the work.
void on_all_processors(size_t count, const std::function<void(size_t)>& work) {
    std::atomic<size_t> next = 0;
    const auto run = [&] {
        for (size_t i = next++; i < count; i = next++) work(i);
    };
    const size_t threads = std::min<size_t>(std::thread::hardware_concurrency(), count);
    std::vector<std::future<void>> others;
    try {
        while (others.size() + 1 < threads) others.push_back(std::async(std::launch::async, run));
    } catch (const std::system_error&) {
        // The system has no thread left.
    }
    run();
    for (std::future<void>& other : others) other.get();
}

}  // namespace

std::vector<uint32_t> images_alike(const GltfDocument& document) {
    std::vector<uint32_t> alike;
    std::map<std::pair<uint32_t, std::string_view>, uint32_t> known;
    for (const GltfImage& image : document.images) {
        std::string_view uri;
        if (image.buffer_view == kNoIndex) uri = image.uri;
        const auto index = static_cast<uint32_t>(alike.size());
        alike.push_back(known.try_emplace({image.buffer_view, uri}, index).first->second);
    }
    return alike;
}

std::vector<GltfImageUse> image_uses(const GltfDocument& document, NormalMaps normal_maps) {
    ImageUses surfaces(document), maps(document);
    for (const GltfMaterial& material : document.materials) {
        add_surface(material, surfaces);
        if (material.is_unlit) continue;
        if (material.emissive_factor != glm::dvec3(0.0)) surfaces.add(material.emission_texture);
        if (material.transmission) surfaces.add(material.transmission->texture);
        if (normal_maps == NormalMaps::Read) maps.add(material.normal_texture);
    }
    std::vector<GltfImageUse> uses;
    surfaces.append_to(uses);
    maps.append_to(uses);
    return uses;
}

Result<ImageSize> gltf_image_size(const GltfDocument& document, uint32_t image) {
    return from_image<ImageSize>(document, image, read_image_size);
}

Result<Image8> decode_gltf_image(const GltfDocument& document, uint32_t image) {
    return from_image<Image8>(document, image, decode_image8);
}

void GltfImages::decode_ahead(std::span<const GltfImageUse> uses) {
    std::set<uint32_t> distinct;
    for (const GltfImageUse& use : uses) distinct.insert(use.image);
    const std::vector<uint32_t> images(distinct.begin(), distinct.end());
    on_all_processors(images.size(), [&](size_t i) {
        decoded_[images[i]] = decode_gltf_image(document_, images[i]);
    });
}

Result<Image8> GltfImages::take(uint32_t image) {
    auto& decoded = decoded_[image];
    if (!decoded) return decode_gltf_image(document_, image);
    auto pixels = std::move(*decoded);
    decoded.reset();
    return pixels;
}

}  // namespace tetralight::detail
