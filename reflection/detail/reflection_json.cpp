// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/detail/reflection_json.h>

#include <span>
#include <string_view>

#include <tetralight/base/hex.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {
namespace {

std::string json_string(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20) {
            quoted += str_cat("\\u", hex(uint64_t{code}, 4));
            continue;
        }
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + '"';
}

/// `[1,2,3]`
template <class Vector>
std::string json_vector(const Vector& v) {
    return str_cat('[', v.x, ',', v.y, ',', v.z, ']');
}

std::string json_vectors(std::span<const glm::vec3> vectors) {
    std::string text;
    for (const glm::vec3& vector : vectors) {
        text += text.empty() ? '[' : ',';
        text += json_vector(vector);
    }
    return text + ']';
}

std::string json_box(const ReflectionProbe& probe) {
    if (probe.is_everywhere()) return "null";
    return str_cat(R"({"center":)", json_vector(probe.box_center), R"(,"half_size":)",
                   json_vector(probe.half_size), R"(,"axes":)", json_vectors(probe.axes), '}');
}

std::string json_probe(const ReflectionProbe& probe, std::string_view name) {
    return str_cat(R"({"name":)", json_string(name), R"(,"position":)", json_vector(probe.position),
                   R"(,"box":)", json_box(probe), R"(,"blend_distance":)", probe.blend_distance,
                   R"(,"importance":)", probe.importance, R"(,"validity":)", probe.validity,
                   R"(,"irradiance_sh":)", json_vectors(probe.irradiance.coefficients), '}');
}

std::string json_roughness(uint32_t level_count) {
    std::string text;
    for (uint32_t level = 0; level < level_count; ++level) {
        text += str_cat(level == 0 ? '[' : ',', roughness_of_level(level, level_count));
    }
    return text + ']';
}

std::string json_layers(const Reflections& reflections) {
    const auto names = split_names(reflections.layer_names);
    std::string text;
    for (size_t k = 0; k < reflections.layers.size() && k < names.size(); ++k) {
        text += str_cat(k == 0 ? '[' : ',', R"({"name":)", json_string(names[k]), R"(,"weight":)",
                        reflections.layers[k].weight, '}');
    }
    return text.empty() ? "" : str_cat(R"(,"layers":)", text, ']');
}

}  // namespace

std::string reflection_json(const Reflections& reflections) {
    const auto level_count = static_cast<uint32_t>(reflections.levels.size());
    std::string probes;
    for (size_t i = 0; i < reflections.probes.size(); ++i) {
        const bool has_name = i < reflections.names.size();
        probes += i == 0 ? '[' : ',';
        probes += json_probe(reflections.probes[i], has_name ? reflections.names[i] : "");
    }
    return str_cat(R"({"version":1,"units":{"length":"m","texels":"radiance",)",
                   R"("irradiance_sh":"irradiance, not divided by pi"},"roughness":)",
                   json_roughness(level_count), json_layers(reflections), R"(,"probes":)", probes,
                   "]}");
}

}  // namespace tetralight::detail
