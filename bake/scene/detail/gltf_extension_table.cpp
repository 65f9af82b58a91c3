// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_extension_table.h>

#include <algorithm>

namespace tetralight::detail {
namespace {

using enum PartUse;

constexpr std::string_view kShiny =
    "changes reflections that are not diffuse, which bakes leave out";
constexpr std::string_view kData = "is data without light";

/// Sorted by name.
constexpr GltfExtension kExtensions[] = {
    {"EXT_lights_area", Read},
    {"EXT_lights_ies", Ignored, false, true, "the light shines as without its profile", ""},
    {"EXT_lights_image_based", Read},
    {"EXT_mesh_features", Ignored, false, false, kData, ""},
    {"EXT_mesh_gpu_instancing", Read},
    {"EXT_meshopt_compression", Read},
    {"EXT_structural_metadata", Ignored, false, false, kData, ""},
    {"EXT_texture_avif", Ignored, false, false, "the texture's other image is read", ""},
    {"EXT_texture_webp", Read},
    {"KHR_animation_pointer", Ignored, false, false,
     "animates properties other than transforms and weights", ""},
    {"KHR_draco_mesh_compression", Read},
    {"KHR_lights_punctual", Read},
    {"KHR_materials_anisotropy", Ignored, false, false, kShiny, ""},
    {"KHR_materials_clearcoat", Approximated, false, false,
     "reflects diffusely as without the coat", ""},
    {"KHR_materials_diffuse_transmission", Ignored, false, true,
     "no light shines through the surface",
     "alphaMode BLEND with an alpha below 1 lets light through"},
    {"KHR_materials_dispersion", Ignored, false, false, kShiny, ""},
    {"KHR_materials_emissive_strength", Read},
    {"KHR_materials_ior", Approximated, false, false, "is read as an index of refraction of 1.5",
     ""},
    {"KHR_materials_iridescence", Ignored, false, false, kShiny, ""},
    {"KHR_materials_pbrSpecularGlossiness", Approximated, true, false,
     "is converted to a metallic-roughness material", ""},
    {"KHR_materials_sheen", Approximated, false, false, "reflects diffusely as without the sheen",
     ""},
    {"KHR_materials_specular", Approximated, false, false,
     "reflects 4 % specularly, as without the extension", ""},
    {"KHR_materials_subsurface", Approximated, false, false,
     "reflects diffusely as without scattering", ""},
    {"KHR_materials_transmission", Approximated, true, false,
     "light shines straight through, as through holes", ""},
    {"KHR_materials_unlit", Read},
    {"KHR_materials_variants", Ignored, false, false, "the default materials are read", ""},
    {"KHR_materials_volume", Ignored, false, true, "light that shines through is not absorbed", ""},
    {"KHR_mesh_quantization", Read},
    {"KHR_meshopt_compression", Ignored, false, true, "the plain buffer views are read",
     "export with EXT_meshopt_compression"},
    {"KHR_node_visibility", Read},
    {"KHR_texture_basisu", Ignored, true, false, "the texture's PNG, JPEG or WebP image is read",
     ""},
    {"KHR_texture_transform", Read},
    {"KHR_xmp", Ignored, false, false, kData, ""},
    {"KHR_xmp_json_ld", Ignored, false, false, kData, ""},
    {"MSFT_lod", Ignored, false, false, "the most detailed level is read", ""},
    {"MSFT_texture_dds", Ignored, false, false, "the texture's other image is read", ""},
    {"MX_lightmap", Ignored, false, false, "is light that was baked before", ""},
    {"MX_texture_rgbm", Ignored, false, false, "is light that was baked before", ""},
    {"VRM", Ignored, false, false, kData, ""},
    {"VRMC_vrm", Ignored, false, false, kData, ""},
};
static_assert(std::ranges::is_sorted(kExtensions, {}, &GltfExtension::name));

}  // namespace

const GltfExtension* find_gltf_extension(std::string_view name) {
    const auto* found = std::ranges::lower_bound(kExtensions, name, {}, &GltfExtension::name);
    return found != std::end(kExtensions) && found->name == name ? found : nullptr;
}

}  // namespace tetralight::detail
