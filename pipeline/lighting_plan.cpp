// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/lighting_plan.h>

#include <algorithm>
#include <string_view>

#include <tetralight/bake/occlusion_channels.h>
#include <tetralight/bake/scene/surface_color.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>

namespace tetralight {
namespace {

constexpr size_t kMaxLayers = 32;

bool is_lit(const glm::vec3& light) {
    return light != glm::vec3(0.0f);
}

bool bakes_light_of(const Material& material) {
    return material.bakes_emission && is_lit(emission_source(material).factor);
}

bool is_baked(const LightPlan& plan, const Scene& scene, size_t light) {
    return plan.mode_of(scene, light) != LightMode::Realtime;
}

/// The names in order, each once: `"a", "b"`.
std::string listed(std::vector<std::string> names) {
    std::ranges::sort(names);
    names.erase(std::ranges::unique(names).begin(), names.end());
    std::string list;
    for (const std::string& name : names) {
        if (!name.empty()) list += str_cat(list.empty() ? "" : ", ", "\"", name, "\"");
    }
    return list.empty() ? "none" : list;
}

/// Builds the plan of one scene.
class Planner {
  public:
    Planner(const Scene& scene, const LightingSettings& settings)
        : scene_(scene), settings_(settings) {}

    Result<LightingPlan> make() {
        plan_channels();
        if (auto status = plan_layers(); !status) return status.error();
        for (size_t i = 0; i < scene_.lights.size(); ++i) {
            plan_.light_states[i].layer = plan_.bake.layer_of(plan_.bake.layer_of_light, i);
        }
        if (plan_.bake.layer_count > 0 && has_light_in_no_layer()) add_rest();
        return std::move(plan_);
    }

  private:
    void plan_channels() {
        const auto channels =
            assign_channels(scene_.lights, scene_.light_names, settings_.mixed_lighting);
        plan_.lights = scene_.lights;
        for (size_t i = 0; i < scene_.lights.size(); ++i) {
            const bool fell_back = channels.fell_back[i];
            if (fell_back) {
                plan_.lights[i].mode = LightMode::Baked;
                plan_.warnings.push_back(str_cat(
                    "light \"", scene_.light_names[i],
                    "\": all four occlusion channels are taken by lights around it; its direct "
                    "light is baked too (give lights a range, or make some of them baked)"));
            }
            plan_.bake.light_modes.push_back(plan_.lights[i].mode);
            plan_.bake.has_occlusion |= channels.of_light[i] != kNoIndex;
            plan_.light_states.push_back(
                {settings_.mixed_lighting, channels.of_light[i], kNoIndex, fell_back});
        }
    }

    Status plan_layers() {
        plan_.bake.layer_of_light.assign(scene_.lights.size(), kNoIndex);
        plan_.bake.layer_of_material.assign(scene_.materials.size(), kNoIndex);
        std::vector<std::string> words = settings_.layers;
        const auto transfer = std::ranges::find(words, "transfer");
        if (transfer != words.end()) {
            plan_.bake.has_transfer = true;
            words.erase(transfer);
            if (std::ranges::find(words, "sky") == words.end()) words.push_back("sky");
        }
        if (words.size() > kMaxLayers) {
            return Error{ErrorCode::InvalidArgument, "layers", str_cat(words.size()),
                         str_cat(words.size(), " layers are more than ", kMaxLayers)};
        }
        plan_.bake.layer_count = static_cast<uint32_t>(words.size());
        for (uint32_t i = 0; i < words.size(); ++i) {
            if (std::ranges::count(words, words[i]) > 1) {
                return Error{ErrorCode::InvalidArgument, "layers", words[i],
                             str_cat("layer \"", words[i], "\" is listed twice")};
            }
            if (auto status = add_named(words[i], i); !status) return status;
        }
        for (uint32_t i = 0; i < words.size(); ++i) add_kind(words[i], i);
        plan_.layer_names = std::move(words);
        add_dark_warnings();
        return Ok{};
    }

    /// "light:NAME" and "material:NAME".
    Status add_named(const std::string& word, uint32_t layer) {
        if (word == "sun" || word == "sky" || word == "emission") return Ok{};
        if (const auto status = check_characters(word); !status) {
            Error error = status.error().in(str_cat("layer \"", word, "\""));
            error.field = "layers";
            return error;
        }
        const size_t colon = word.find(':');
        const std::string kind = word.substr(0, colon);
        const std::string name = colon == std::string::npos ? "" : word.substr(colon + 1);
        if (!name.empty() && kind == "light") return add_lights(name, layer);
        if (!name.empty() && kind == "material") return add_materials(name, layer);
        return Error{
            ErrorCode::InvalidArgument, "layers", word,
            str_cat("layer \"", word,
                    "\" is none of sun, sky, emission, transfer, light:NAME, material:NAME")};
    }

    Status add_lights(const std::string& name, uint32_t layer) {
        size_t count = 0;
        for (size_t i = 0; i < scene_.lights.size(); ++i) {
            if (scene_.light_names[i] != name) continue;
            ++count;
            if (!is_baked(plan_.bake, scene_, i)) {
                return Error{
                    ErrorCode::InvalidArgument, "layers", "light:" + name,
                    str_cat("layer \"light:", name, "\": the light is realtime and is not baked")};
            }
            plan_.bake.layer_of_light[i] = layer;
        }
        if (count > 0) return Ok{};
        return Error{ErrorCode::NotFound, "layers", "light:" + name,
                     str_cat("layer \"light:", name, "\": the scene has no such light; it has ",
                             listed(scene_.light_names))};
    }

    Status add_materials(const std::string& name, uint32_t layer) {
        size_t count = 0;
        std::vector<std::string> emissive;
        for (size_t i = 0; i < scene_.materials.size(); ++i) {
            const Material& material = scene_.materials[i];
            if (bakes_light_of(material)) emissive.push_back(material.name);
            if (material.name != name) continue;
            ++count;
            plan_.bake.layer_of_material[i] = layer;
        }
        if (count > 0) return Ok{};
        return Error{ErrorCode::NotFound, "layers", "material:" + name,
                     str_cat("layer \"material:", name,
                             "\": the scene has no such material; emissive materials are ",
                             listed(emissive))};
    }

    /// "sun", "sky" and "emission": lights and materials in no layer yet.
    void add_kind(const std::string& word, uint32_t layer) {
        if (word == "sky") plan_.bake.layer_of_sky = layer;
        if (word == "sun") {
            for (size_t i = 0; i < scene_.lights.size(); ++i) {
                uint32_t& of_light = plan_.bake.layer_of_light[i];
                const bool is_sun = scene_.lights[i].type == LightType::Directional;
                if (is_sun && of_light == kNoIndex && is_baked(plan_.bake, scene_, i)) {
                    of_light = layer;
                }
            }
        }
        if (word == "emission") {
            for (uint32_t& of_material : plan_.bake.layer_of_material) {
                if (of_material == kNoIndex) of_material = layer;
            }
        }
    }

    /// Calls `visit(layer)` for each light, emissive material and sky that is baked.
    template <class Visit>
    void for_each_source(Visit visit) const {
        for (size_t i = 0; i < scene_.lights.size(); ++i) {
            const bool is_dark = !is_lit(scene_.lights[i].intensity);
            if (!is_dark && is_baked(plan_.bake, scene_, i)) visit(plan_.bake.layer_of_light[i]);
        }
        for (size_t i = 0; i < scene_.materials.size(); ++i) {
            if (bakes_light_of(scene_.materials[i])) visit(plan_.bake.layer_of_material[i]);
        }
        if (is_lit(scene_.environment.radiance)) visit(plan_.bake.layer_of_sky);
    }

    [[nodiscard]] bool has_light_in_no_layer() const {
        bool is_found = false;
        for_each_source([&](uint32_t layer) { is_found |= layer == kNoIndex; });
        return is_found;
    }

    void add_dark_warnings() {
        std::vector<bool> has_light(plan_.layer_names.size(), false);
        for_each_source([&](uint32_t layer) {
            if (layer != kNoIndex) has_light[layer] = true;
        });
        for (size_t i = 0; i < has_light.size(); ++i) {
            const std::string& name = plan_.layer_names[i];
            const bool is_lit_later = name == "sky" && plan_.bake.has_transfer;
            if (has_light[i] || is_lit_later) continue;
            plan_.warnings.push_back(str_cat("layer \"", name,
                                             "\" is dark: nothing in the scene lights "
                                             "it"));
        }
    }

    void add_rest() {
        const auto rest = static_cast<uint32_t>(plan_.layer_names.size());
        plan_.layer_names.push_back("rest");
        plan_.bake.has_rest = true;
        for (size_t i = 0; i < scene_.lights.size(); ++i) {
            uint32_t& layer = plan_.light_states[i].layer;
            if (layer == kNoIndex && is_baked(plan_.bake, scene_, i)) layer = rest;
        }
    }

    const Scene& scene_;
    const LightingSettings& settings_;
    LightingPlan plan_;
};

}  // namespace

std::vector<uint32_t> channels_of(const std::vector<LightState>& states) {
    std::vector<uint32_t> channels;
    for (const LightState& state : states) channels.push_back(state.channel);
    return channels;
}

Result<LightingPlan> plan_lighting(const Scene& scene, const LightingSettings& settings) {
    TETRALIGHT_ASSERT(scene.light_names.size() == scene.lights.size(), "one name for each light");
    return Planner(scene, settings).make();
}

}  // namespace tetralight
