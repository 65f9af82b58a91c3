// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <tetralight/base/str_cat.h>
#include <tetralight/lightmap/detail/verify_rectangles.h>
#include <tetralight/lightmap/detail/verify_texels.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/section_error.h>
#include <tetralight/probes/section_text.h>

namespace tetralight {
namespace {

Error wrong_info(std::string_view member, const std::string& what) {
    Error error = detail::section_error("info", what);
    error.field = str_cat("info.", member);
    return error;
}

Status check_lightmap_info(const LightmapInfo& info) {
    if (info.page_size > kLargestPageSize || (info.page_size == 0 && info.page_count > 0)) {
        return wrong_info("page_size", str_cat("page size ", info.page_size, " is not in 1 to ",
                                               kLargestPageSize));
    }
    if (!std::isfinite(info.texels_per_meter) || info.texels_per_meter < 0.0f) {
        return wrong_info("texels_per_meter",
                          str_cat(info.texels_per_meter, " texels a metre are out of range"));
    }
    if (!detail::is_lightmap_scale(info.scale)) {
        return wrong_info("scale",
                          str_cat("scale ", info.scale, " is not a power of two in 2^-64 to 2^64"));
    }
    if (info.mixed_lighting > MixedLighting::Subtractive) {
        return wrong_info("mixed_lighting",
                          str_cat("mixed lighting ", static_cast<uint32_t>(info.mixed_lighting),
                                  " is not known"));
    }
    if (!std::isfinite(info.ambient_occlusion_distance) || info.ambient_occlusion_distance < 0.0f) {
        return wrong_info(
            "ambient_occlusion_distance",
            str_cat("a distance of ", info.ambient_occlusion_distance, " metres is out of range"));
    }
    if (info.reserved == std::array<uint32_t, 10>{}) return Ok{};
    return wrong_info("reserved", "a reserved word is not zero");
}

enum class Presence { Required, Optional };

/// Counts of texels are products that exceed 32 bits.
Status check_element_count(std::string_view section, size_t count, uint64_t expected,
                           Presence presence = Presence::Optional) {
    if (count == expected || (count == 0 && presence == Presence::Optional)) return Ok{};
    return detail::section_error(section, str_cat(count, " elements instead of ", expected));
}

Status check_element_counts(const LightmapsView& v) {
    const uint64_t texels = v.texel_count();
    const size_t names = split_names(v.layer_names).size();
    for (const Status& status :
         {check_element_count("irradiance", v.irradiance.size(), texels, Presence::Required),
          check_element_count("light", v.light.size(), texels),
          check_element_count("validity", v.validity.size(), texels),
          check_element_count("error", v.error.size(), texels),
          check_element_count("shadow_mask", v.shadow_mask.size(), texels),
          check_element_count("ambient_occlusion", v.ambient_occlusion.size(), texels),
          check_element_count("instance_names", split_names(v.instance_names).size(),
                              v.rectangles.size()),
          check_element_count("layer_names", names, v.layers.size(), Presence::Required)}) {
        if (!status) return status;
    }
    // `irradiance` has as many elements, so that these products do not overflow.
    for (const Status& status :
         {check_element_count("layer_irradiance", v.layer_irradiance.size(),
                              v.layers.size() * texels),
          check_element_count("layer_light", v.layer_light.size(), v.layers.size() * texels)}) {
        if (!status) return status;
    }
    return Ok{};
}

Status check_texts(const LightmapsView& v) {
    if (auto s = detail::check_names("instance_names", v.instance_names); !s) return s;
    if (auto s = detail::check_distinct_names("layer_names", v.layer_names); !s) return s;
    return detail::check_metadata_text(v.metadata);
}

Status check_meshes(const LightmapsView& v) {
    for (size_t i = 0; i < v.meshes.size(); ++i) {
        const LightmapMesh& mesh = v.meshes[i];
        const uint64_t end = mesh.first_corner + 3 * uint64_t{mesh.triangle_count};
        if (end > v.corner_uvs.size()) {
            return detail::element_error("meshes", i,
                                         str_cat("corners ", mesh.first_corner, " to ", end,
                                                 " are out of range (", v.corner_uvs.size(), ")"));
        }
        if (mesh.reserved != std::array<uint32_t, 2>{}) {
            return detail::element_error("meshes", i, "has a reserved word that is not zero");
        }
    }
    for (size_t i = 0; i < v.corner_uvs.size(); ++i) {
        const glm::vec2& uv = v.corner_uvs[i];
        if (uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f) continue;
        return detail::element_error("corner_uvs", i,
                                     str_cat("(", uv.x, ", ", uv.y, ") is not in [0, 1]"));
    }
    return Ok{};
}

Status check_lightmap_layers(const LightmapsView& v) {
    for (size_t i = 0; i < v.layers.size(); ++i) {
        const LightmapLayer& layer = v.layers[i];
        if (!std::isfinite(layer.weight) || layer.weight < 0.0f) {
            return detail::element_error("layers", i,
                                         str_cat("weight ", layer.weight, " is out of range"));
        }
        if (!detail::is_lightmap_scale(layer.scale)) {
            return detail::element_error(
                "layers", i,
                str_cat("scale ", layer.scale, " is not a power of two in 2^-64 to 2^64"));
        }
        if (layer.reserved != std::array<uint32_t, 2>{}) {
            return detail::element_error("layers", i, "has a reserved word that is not zero");
        }
    }
    return Ok{};
}

}  // namespace

Status verify(const LightmapsView& lightmaps) {
    if (auto status = check_lightmap_info(lightmaps.info); !status) return status;
    if (auto status = check_element_counts(lightmaps); !status) return status;
    if (auto status = check_texts(lightmaps); !status) return status;
    if (auto status = check_meshes(lightmaps); !status) return status;
    if (auto status = detail::check_rectangles(lightmaps); !status) return status;
    if (auto status = check_lightmap_layers(lightmaps); !status) return status;
    return detail::check_texels(lightmaps);
}

}  // namespace tetralight
