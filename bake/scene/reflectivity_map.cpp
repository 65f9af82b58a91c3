// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/reflectivity_map.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <span>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <tetralight/bake/image/srgb.h>
#include <tetralight/bake/scene/detail/texel_pair.h>
#include <tetralight/bake/scene/texture.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/half.h>

namespace tetralight {
namespace {

/// Limit of the texels of one level.
constexpr uint64_t kMaxLevelTexels = uint64_t{1} << 20;
constexpr uint32_t kLevelCount = 3;

struct Size {
    uint32_t width = 0;
    uint32_t height = 0;
};

/// A mean over texels, by their opacity: reflectivity times opacity, and opacity. Without a texture
/// of metallic and roughness and with linear settings, the base color in place of reflectivity.
struct OpaqueMean {
    glm::vec4 reflectivity{0.0f};
    float opacity = 0.0f;
};

/// Half the size, rounded up, `times` times.
Size halved(Size size, uint32_t times) {
    const auto half = [&](uint32_t length) {
        return static_cast<uint32_t>(((uint64_t{length} - 1) >> times) + 1);
    };
    return {half(size.width), half(size.height)};
}

uint64_t texel_count(Size size) {
    return uint64_t{size.width} * size.height;
}

const Texture* texture_of(const Scene& scene, const TextureUse& use) {
    return use.texture == kNoIndex ? nullptr : &scene.textures[use.texture];
}

const TextureUse& main_use(const Material& material) {
    return material.base_color_texture.texture != kNoIndex ? material.base_color_texture
                                                           : material.metallic_roughness_texture;
}

bool share_coordinates(const Scene& scene, const TextureUse& a, const TextureUse& b) {
    const Texture& first = scene.textures[a.texture];
    const Texture& second = scene.textures[b.texture];
    return a.uv_set == b.uv_set && a.image_from_mesh == b.image_from_mesh &&
           first.wrap_u == second.wrap_u && first.wrap_v == second.wrap_v;
}

/// The size in which the textures of a material are combined; 0 without textures.
Size combined_size(const Scene& scene, const Material& material) {
    Size size;
    for (const TextureUse& use :
         {material.base_color_texture, material.metallic_roughness_texture}) {
        const Texture* texture = texture_of(scene, use);
        if (texture == nullptr) continue;
        size.width = std::max(size.width, texture->image.width);
        size.height = std::max(size.height, texture->image.height);
    }
    return size;
}

/// How many times the textures are halved for the finest level.
uint32_t finest_level(Size size) {
    uint32_t level = 1;
    while (texel_count(halved(size, level)) > kMaxLevelTexels) ++level;
    return level;
}

/// The reflectivity of a material texel by texel.
class MaterialTexels {
  public:
    MaterialTexels(const Scene& scene, const Material& material, const SurfaceSettings& settings)
        : material_(material),
          settings_(settings),
          is_linear_(settings == SurfaceSettings{}),
          size_(combined_size(scene, material)),
          colors_(texture_of(scene, material.base_color_texture)),
          factors_(texture_of(scene, material.metallic_roughness_texture)),
          linear_(linear_from_srgb8_codes()) {}

    [[nodiscard]] Size size() const { return size_; }

    [[nodiscard]] OpaqueMean at(uint32_t x, uint32_t y) const {
        const glm::vec4 color = material_.base_color * color_at(x, y);
        const float opacity = opacity_of(color.a);
        if (factors_ == nullptr && is_linear_) return {opacity * color, opacity};
        const glm::vec4 factors = factors_at(x, y);
        return {opacity * reflectivity(glm::vec3(color), material_.metallic * factors.b,
                                       material_.roughness * factors.g),
                opacity};
    }

    /// The reflectivity from a mean of `at`: those of colors alone are linear in their mean.
    [[nodiscard]] glm::vec4 from_mean(const glm::vec4& mean) const {
        if (factors_ != nullptr || !is_linear_) return mean;
        return reflectivity(glm::vec3(mean), material_.metallic, material_.roughness);
    }

    [[nodiscard]] glm::vec4 reflectivity(glm::vec3 color, float metallic, float roughness) const {
        if (is_linear_) {
            const ReflectivityTerms terms = reflectivity_terms(metallic, roughness);
            return {terms.per_color * color, terms.colorless};
        }
        return {adjusted_albedo(diffuse_reflectivity(color, metallic, roughness), settings_), 0.0f};
    }

  private:
    [[nodiscard]] glm::vec2 center(uint32_t x, uint32_t y) const {
        return (glm::vec2(x, y) + 0.5f) / glm::vec2(size_.width, size_.height);
    }

    /// The texel of an image of the combined size.
    [[nodiscard]] const std::array<uint8_t, 4>* texel(const Texture& texture, uint32_t x,
                                                      uint32_t y) const {
        const Image8& image = texture.image;
        const bool is_same_size = image.width == size_.width && image.height == size_.height;
        return is_same_size ? &image.pixels[size_t{y} * image.width + x] : nullptr;
    }

    [[nodiscard]] glm::vec4 color_at(uint32_t x, uint32_t y) const {
        if (colors_ == nullptr) return glm::vec4(1.0f);
        const auto* code = texel(*colors_, x, y);
        if (code == nullptr) return sample_texture(*colors_, center(x, y));
        return {linear_[(*code)[0]], linear_[(*code)[1]], linear_[(*code)[2]],
                static_cast<float>((*code)[3]) / 255.0f};
    }

    [[nodiscard]] glm::vec4 factors_at(uint32_t x, uint32_t y) const {
        if (factors_ == nullptr) return glm::vec4(1.0f);
        const auto* code = texel(*factors_, x, y);
        if (code == nullptr) return sample_data_texture(*factors_, center(x, y));
        return glm::vec4((*code)[0], (*code)[1], (*code)[2], (*code)[3]) / 255.0f;
    }

    [[nodiscard]] float opacity_of(float alpha) const {
        switch (material_.alpha_mode) {
            case AlphaMode::Opaque:
                break;
            case AlphaMode::Mask:
                return alpha >= material_.alpha_cutoff ? 1.0f : 0.0f;
            case AlphaMode::Blend:
                return std::clamp(alpha, 0.0f, 1.0f);
        }
        return 1.0f;
    }

    const Material& material_;
    const SurfaceSettings& settings_;
    bool is_linear_ = true;
    Size size_;
    const Texture* colors_ = nullptr;
    const Texture* factors_ = nullptr;
    const std::array<float, 256>& linear_;
};

/// Part of a row or column of texels: those from `begin` to `end`, of which the outer two count by
/// the part of them that is covered.
struct Span {
    uint32_t begin = 0;
    uint32_t end = 0;
    float first_weight = 1.0f;
    float last_weight = 1.0f;

    [[nodiscard]] float weight(uint32_t i) const {
        return i == begin ? first_weight : (i + 1 == end ? last_weight : 1.0f);
    }
};

/// The texels under texel `i` of `to` when `from` texels are reduced to `to` ones.
Span covered(uint32_t i, uint32_t from, uint32_t to) {
    const uint64_t low = uint64_t{i} * from, high = low + from;  // in units of 1/to of a texel
    Span span;
    span.begin = static_cast<uint32_t>(low / to);
    span.end = static_cast<uint32_t>((high + to - 1) / to);
    const auto part = [&](uint64_t units) {
        return static_cast<float>(units) / static_cast<float>(to);
    };
    span.first_weight = part(std::min((uint64_t{span.begin} + 1) * to, high) - low);
    span.last_weight = part(high - std::max((uint64_t{span.end} - 1) * to, low));
    return span;
}

/// Box filter: the mean of the texels under each texel of a smaller image, by area.
template <class TexelAt>
std::vector<OpaqueMean> reduced_image(Size from, Size to, const TexelAt& texel_at) {
    std::vector<OpaqueMean> result(texel_count(to));
    std::vector<Span> columns(to.width);
    for (uint32_t x = 0; x < to.width; ++x) columns[x] = covered(x, from.width, to.width);
    const float per_area = (static_cast<float>(to.width) / static_cast<float>(from.width)) *
                           (static_cast<float>(to.height) / static_cast<float>(from.height));
    for (uint32_t y = 0; y < to.height; ++y) {
        const Span rows = covered(y, from.height, to.height);
        OpaqueMean* means = &result[size_t{y} * to.width];
        for (uint32_t row = rows.begin; row < rows.end; ++row) {
            const float row_weight = rows.weight(row) * per_area;
            for (uint32_t x = 0; x < to.width; ++x) {
                const Span span = columns[x];
                OpaqueMean mean = means[x];
                for (uint32_t column = span.begin; column < span.end; ++column) {
                    const float weight = row_weight * span.weight(column);
                    const OpaqueMean texel = texel_at(column, row);
                    mean.reflectivity += weight * texel.reflectivity;
                    mean.opacity += weight * texel.opacity;
                }
                means[x] = mean;
            }
        }
    }
    return result;
}

/// An image of means.
struct MeanImage {
    Size size;
    std::vector<OpaqueMean> means;
};

/// The mean of the next larger area around a texel of the first image that has an opaque part.
/// Images are ordered from fine to coarse.
glm::vec4 mean_around(std::span<const MeanImage> images, uint32_t x, uint32_t y) {
    const Size size = images.front().size;
    for (const MeanImage& image : images.subspan(1)) {
        const auto column = static_cast<uint32_t>(uint64_t{x} * image.size.width / size.width);
        const auto row = static_cast<uint32_t>(uint64_t{y} * image.size.height / size.height);
        const OpaqueMean& mean = image.means[size_t{row} * image.size.width + column];
        if (mean.opacity > 0.0f) return mean.reflectivity / mean.opacity;
    }
    return glm::vec4(0.0f);
}

/// Threads of a bake read denormal floats as 0 and others do not: none is stored.
uint16_t half_of(float value) {
    constexpr float kSmallestNormal = 0x1p-14f;
    return value < kSmallestNormal ? uint16_t{0} : half_from_float_saturated(value);
}

/// The first image in half floats; hidden texels get the mean around them.
ReflectivityLevel encoded(std::span<const MeanImage> images, const MaterialTexels& material) {
    const auto& [size, means] = images.front();
    ReflectivityLevel level{size.width, size.height, {}};
    level.texels.reserve(means.size());
    for (uint32_t y = 0; y < size.height; ++y) {
        for (uint32_t x = 0; x < size.width; ++x) {
            const OpaqueMean& mean = means[size_t{y} * size.width + x];
            const glm::vec4 value = material.from_mean(
                mean.opacity > 0.0f ? mean.reflectivity / mean.opacity : mean_around(images, x, y));
            level.texels.push_back(
                {half_of(value.x), half_of(value.y), half_of(value.z), half_of(value.w)});
        }
    }
    return level;
}

/// Shifts the digits of a half float to those of a float, whose exponent is then too small by 112.
constexpr int kHalfShift = 13;
constexpr float kHalfScale = 0x1p112f;

#if defined(__SSE2__)

/// The weighted sum of four texels.
class TexelSum {
  public:
    void add(const ReflectivityTexel& texel, float weight) {
        const __m128i halves = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(texel.data()));
        const __m128i bits =
            _mm_slli_epi32(_mm_unpacklo_epi16(halves, _mm_setzero_si128()), kHalfShift);
        sum_ = _mm_add_ps(sum_, _mm_mul_ps(_mm_castsi128_ps(bits), _mm_set1_ps(weight)));
    }

    [[nodiscard]] glm::vec4 value() const {
        alignas(16) float values[4];
        _mm_store_ps(values, sum_);
        return {values[0], values[1], values[2], values[3]};
    }

  private:
    __m128 sum_ = _mm_setzero_ps();
};

#else

/// The weighted sum of four texels.
class TexelSum {
  public:
    void add(const ReflectivityTexel& texel, float weight) {
        for (int i = 0; i < 4; ++i) {
            sum_[i] += std::bit_cast<float>(uint32_t{texel[i]} << kHalfShift) * weight;
        }
    }

    [[nodiscard]] glm::vec4 value() const { return sum_; }

  private:
    glm::vec4 sum_{0.0f};
};

#endif

}  // namespace

bool has_reflectivity_map(const Scene& scene, const Material& material,
                          const SurfaceSettings& settings, bool has_vertex_colors) {
    if (material.is_unlit) return false;
    if (has_vertex_colors && settings != SurfaceSettings{}) return false;
    const TextureUse& colors = material.base_color_texture;
    const TextureUse& factors = material.metallic_roughness_texture;
    if (colors.texture == kNoIndex || factors.texture == kNoIndex) return true;
    return share_coordinates(scene, colors, factors);
}

ReflectivityMap make_reflectivity_map(const Scene& scene, const Material& material,
                                      const SurfaceSettings& settings) {
    const MaterialTexels texels(scene, material, settings);
    ReflectivityMap map;
    map.constant =
        texels.reflectivity(glm::vec3(material.base_color), material.metallic, material.roughness);
    const TextureUse& use = main_use(material);
    if (use.texture == kNoIndex) return map;

    const Texture& texture = scene.textures[use.texture];
    const Size size = texels.size();
    const uint32_t finest = finest_level(size);
    map.uv_set = use.uv_set;
    map.image_from_mesh = use.image_from_mesh;
    map.wrap_u = texture.wrap_u;
    map.wrap_v = texture.wrap_v;
    const glm::mat3& m = use.image_from_mesh;
    const float area_scale = std::abs(m[0].x * m[1].y - m[1].x * m[0].y);
    map.texels_per_uv = std::sqrt(area_scale * static_cast<float>(texel_count(size)));
    map.finest_texels = static_cast<float>(uint64_t{1} << finest);

    std::vector<MeanImage> images;
    const Size finest_size = halved(size, finest);
    const auto at = [&](uint32_t x, uint32_t y) { return texels.at(x, y); };
    images.push_back({finest_size, reduced_image(size, finest_size, at)});
    const bool has_hidden_texels = material.alpha_mode != AlphaMode::Opaque;
    while (images.size() < kLevelCount ||
           (has_hidden_texels && texel_count(images.back().size) > 1)) {
        const MeanImage& fine = images.back();
        const Size half = halved(fine.size, 1);
        const auto mean_at = [&](uint32_t x, uint32_t y) {
            return fine.means[size_t{y} * fine.size.width + x];
        };
        images.push_back({half, reduced_image(fine.size, half, mean_at)});
    }
    for (size_t level = 0; level < kLevelCount; ++level) {
        map.levels.push_back(encoded(std::span(images).subspan(level), texels));
    }
    return map;
}

uint64_t reflectivity_map_bytes(const Scene& scene, const Material& material) {
    const Size size = combined_size(scene, material);
    if (texel_count(size) == 0) return 0;
    Size level = halved(size, finest_level(size));
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < kLevelCount; ++i, level = halved(level, 1)) {
        bytes += texel_count(level) * sizeof(ReflectivityTexel);
    }
    return bytes;
}

glm::vec4 sample_reflectivity(const ReflectivityMap& map, size_t level_index, glm::vec2 uv) {
    const ReflectivityLevel& level = map.levels[level_index];
    const detail::TexelPair x = detail::texels_at(uv.x, level.width, map.wrap_u);
    const detail::TexelPair y = detail::texels_at(uv.y, level.height, map.wrap_v);
    const ReflectivityTexel* first = level.texels.data() + size_t{y.first} * level.width;
    const ReflectivityTexel* second = level.texels.data() + size_t{y.second} * level.width;
    const float second_row = kHalfScale * y.second_weight;
    const float first_row = kHalfScale - second_row;
    TexelSum sum;
    sum.add(first[x.first], first_row * (1.0f - x.second_weight));
    sum.add(first[x.second], first_row * x.second_weight);
    sum.add(second[x.first], second_row * (1.0f - x.second_weight));
    sum.add(second[x.second], second_row * x.second_weight);
    return sum.value();
}

std::optional<glm::vec4> filtered_reflectivity(const ReflectivityMap& map, glm::vec2 mesh_uv,
                                               float footprint) {
    if (map.levels.empty()) return map.constant;
    float texels = map.finest_texels;
    const float footprint_texels = footprint * map.texels_per_uv;
    if (!(footprint_texels >= texels)) return std::nullopt;
    size_t level = 0;
    while (level + 1 < map.levels.size() && footprint_texels >= 2.0f * texels) {
        texels *= 2.0f;
        ++level;
    }
    const glm::vec2 uv = map.image_from_mesh * glm::vec3(mesh_uv, 1.0f);
    return sample_reflectivity(map, level, uv);
}

}  // namespace tetralight
