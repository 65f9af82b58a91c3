// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/exported_texels.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>

#include <tetralight/base/half.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/lightmap/directional_light.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {
namespace {

glm::vec3 value_of(const std::array<uint16_t, 3>& halves, float scale) {
    return glm::vec3(float_from_half(halves[0]), float_from_half(halves[1]),
                     float_from_half(halves[2])) *
           scale;
}

glm::vec3 irradiance_of(const LightmapsView& maps, size_t texel) {
    return value_of(maps.irradiance[texel].rgb, maps.info.scale);
}

float fraction_of(uint8_t byte) {
    return static_cast<float>(byte) / 255.0f;
}

ExportedTexels values_of(const LightmapsView& maps) {
    ExportedTexels values;
    values.page_size = maps.info.page_size;
    values.page_count = maps.info.page_count;
    return values;
}

glm::vec3 direction_of_light(const LightmapTexel& texel) {
    std::array<glm::vec3, 3> vectors;
    for (size_t channel = 0; channel < 3; ++channel)
        vectors[channel] = value_of(texel.vector[channel], 1.0f);
    return mono_vector(value_of(texel.flux, 1.0f), vectors);
}

/// E / φ of luminances is n0 · u: no normal is needed.
glm::vec4 direction_value(const LightmapsView& maps, size_t texel) {
    const glm::vec3 u = direction_of_light(maps.light[texel]);
    const float length = glm::length(u);
    if (!(length > 0.0f)) return glm::vec4(0.5f);
    const glm::vec3 w = u * (std::min(1.0f, 2.0f * length) / length);
    const glm::vec3 flux = value_of(maps.light[texel].flux, maps.info.scale);
    const float ratio =
        glm::dot(kLuminanceWeights, irradiance_of(maps, texel)) / glm::dot(kLuminanceWeights, flux);
    const float on_surface = std::clamp(ratio / length * glm::length(w), 0.0f, 1.0f);
    return {0.5f + 0.5f * w, 0.5f + 0.5f * on_surface};
}

Error missing_map(const char* name, const char* what, const char* remedy) {
    return Error{ErrorCode::InvalidArgument, "map", name,
                 str_cat("the lightmaps have no ", what, "; ", remedy)};
}

constexpr const char* kBakeMask = "bake them with --mixed-lighting shadowmask";
constexpr const char* kBakeOcclusion = "bake them with --ambient-occlusion";

/// A channel of packed values.
struct Channel {
    std::function<float(size_t texel)> at;
    bool is_fraction = false;
};

/// Finds channels by their words.
class ChannelFinder {
  public:
    explicit ChannelFinder(const LightmapsView& maps)
        : maps_(maps), layers_(split_names(maps.layer_names)) {}

    [[nodiscard]] Result<Channel> find(const std::string& word) const {
        if (auto channel = named(word)) return *channel;
        const size_t caret = word.rfind('^');
        if (caret == std::string::npos) return unknown(word);
        const auto channel = named(std::string_view(word).substr(0, caret));
        if (!channel) return unknown(word);
        const char* end = word.data() + word.size();
        float power = 0.0f;
        const auto read = std::from_chars(word.data() + caret + 1, end, power);
        const bool is_good =
            read.ec == std::errc() && read.ptr == end && power > 0.0f && power <= 100.0f;
        if (!is_good)
            return refused(word, str_cat("\"", word, "\" needs an exponent above 0, up to 100"));
        return Channel{
            [at = channel->at, power](size_t texel) { return std::pow(at(texel), power); },
            channel->is_fraction};
    }

  private:
    [[nodiscard]] static Error refused(const std::string& word, const std::string& message) {
        return Error{ErrorCode::InvalidArgument, "pack", word, "pack: " + message};
    }

    [[nodiscard]] Error unknown(const std::string& word) const {
        std::string known;
        for (const std::string_view layer : layers_) known += str_cat(layer, ", ");
        if (find_layer("sky")) known += "sky-occlusion, ";
        if (!maps_.shadow_mask.empty()) known += "shadow:0 to shadow:3, ";
        if (!maps_.ambient_occlusion.empty()) known += "ambient-occlusion, ";
        return refused(
            word, str_cat("unknown channel \"", word, "\"; the lightmaps have ", known, "light"));
    }

    [[nodiscard]] std::optional<size_t> find_layer(std::string_view name) const {
        const auto found = std::ranges::find(layers_, name);
        const bool has_light =
            maps_.layer_irradiance.size() >= layers_.size() * maps_.texel_count();
        if (found == layers_.end() || !has_light) return std::nullopt;
        return static_cast<size_t>(found - layers_.begin());
    }

    [[nodiscard]] float layer_luminance(size_t layer, size_t texel) const {
        const LayerTexel& light = maps_.layer_irradiance[layer * maps_.texel_count() + texel];
        return glm::dot(kLuminanceWeights, value_of(light.rgb, maps_.layers[layer].scale));
    }

    [[nodiscard]] std::optional<Channel> named(std::string_view name) const {
        if (const auto layer = find_layer(name)) {
            return Channel{[*this, layer](size_t texel) { return layer_luminance(*layer, texel); },
                           false};
        }
        if (name == "light") {
            return Channel{[maps = maps_](size_t texel) {
                               return glm::dot(kLuminanceWeights, irradiance_of(maps, texel));
                           },
                           false};
        }
        if (name == "sky-occlusion") return sky_occlusion();
        const bool is_shadow = name.size() == 8 && name.starts_with("shadow:") &&
                               name.back() >= '0' && name.back() <= '3';
        if (is_shadow && !maps_.shadow_mask.empty()) {
            const auto channel = static_cast<size_t>(name.back() - '0');
            return Channel{[maps = maps_, channel](size_t texel) {
                               return fraction_of(maps.shadow_mask[texel][channel]);
                           },
                           true};
        }
        if (name == "ambient-occlusion" && !maps_.ambient_occlusion.empty()) {
            return Channel{
                [maps = maps_](size_t texel) { return fraction_of(maps.ambient_occlusion[texel]); },
                true};
        }
        return std::nullopt;
    }

    [[nodiscard]] std::optional<Channel> sky_occlusion() const {
        const auto sky = find_layer("sky");
        if (!sky) return std::nullopt;
        float largest = 0.0f;
        for (size_t texel = 0; texel < maps_.texel_count(); ++texel)
            largest = std::max(largest, layer_luminance(*sky, texel));
        const float factor = largest > 0.0f ? 1.0f / largest : 0.0f;
        return Channel{[*this, sky, factor](size_t texel) {
                           return std::min(1.0f, factor * layer_luminance(*sky, texel));
                       },
                       true};
    }

    LightmapsView maps_;
    std::vector<std::string_view> layers_;
};

}  // namespace

Result<ExportedTexels> map_values(const LightmapsView& maps, LightmapMap map) {
    ExportedTexels values = values_of(maps);
    values.is_fraction = map != LightmapMap::Irradiance;
    switch (map) {
        case LightmapMap::Irradiance:
            values.at = [maps](size_t texel) {
                const float coverage = float_from_half(maps.irradiance[texel].coverage);
                return glm::vec4(irradiance_of(maps, texel), coverage);
            };
            break;
        case LightmapMap::Direction:
            if (maps.light.empty()) return missing_map("direction", "directions", "bake them anew");
            values.channel_count = 4;
            values.at = [maps](size_t texel) { return direction_value(maps, texel); };
            break;
        case LightmapMap::MonoSh:
            if (maps.light.empty()) return missing_map("mono-sh", "directions", "bake them anew");
            values.at = [maps](size_t texel) {
                return glm::vec4(0.5f + 0.5f * direction_of_light(maps.light[texel]), 1.0f);
            };
            break;
        case LightmapMap::ShadowMask:
            if (maps.shadow_mask.empty())
                return missing_map("shadow-mask", "shadow mask", kBakeMask);
            values.channel_count = 4;
            values.at = [maps](size_t texel) {
                const auto& [r, g, b, a] = maps.shadow_mask[texel];
                return glm::vec4(fraction_of(r), fraction_of(g), fraction_of(b), fraction_of(a));
            };
            break;
        case LightmapMap::AmbientOcclusion:
            if (maps.ambient_occlusion.empty())
                return missing_map("ambient-occlusion", "ambient occlusion", kBakeOcclusion);
            values.at = [maps](size_t texel) {
                return glm::vec4(glm::vec3(fraction_of(maps.ambient_occlusion[texel])), 1.0f);
            };
            break;
    }
    return values;
}

Result<ExportedTexels> packed_values(const LightmapsView& maps,
                                     const std::vector<std::string>& words) {
    if (words.empty() || words.size() > 4) {
        return Error{ErrorCode::InvalidArgument, "pack", str_cat(words.size()),
                     str_cat("pack: ", words.size(), " channels are not 1 to 4")};
    }
    const ChannelFinder finder(maps);
    std::vector<Channel> channels;
    for (const std::string& word : words) {
        auto channel = finder.find(word);
        if (!channel) return channel.error();
        channels.push_back(std::move(*channel));
    }
    ExportedTexels values = values_of(maps);
    values.channel_count = channels.size() == 4 ? 4 : 3;
    values.is_fraction = std::ranges::all_of(channels, &Channel::is_fraction);
    values.at = [channels](size_t texel) {
        glm::vec4 value(0.0f, 0.0f, 0.0f, channels.size() == 4 ? 0.0f : 1.0f);
        for (size_t i = 0; i < channels.size(); ++i)
            value[static_cast<int>(i)] = channels[i].at(texel);
        return value;
    };
    return values;
}

}  // namespace tetralight
