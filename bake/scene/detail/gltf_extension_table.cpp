// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_extension_table.h>

#include <algorithm>

namespace tetralight::detail {
namespace {

using enum PartUse;

constexpr std::string_view kShiny =
    "changes reflections that are not diffuse, which bakes leave out";
constexpr std::string_view kData = "is data without light";
constexpr std::string_view kOtherImage = "the texture's PNG, JPEG or WebP image is read";

/// Sorted by name.
constexpr GltfExtension kExtensions[] = {
    {"EXT_lights_area", Read},
    {"EXT_lights_ies", Ignored, false, true, "the light shines as without its profile", ""},
    {"EXT_lights_image_based", Read},
    {"EXT_mesh_features", Ignored, true, false, kData, ""},
    {"EXT_mesh_gpu_instancing", Read},
    {"EXT_meshopt_compression", Read},
    {"EXT_structural_metadata", Ignored, true, false, kData, ""},
    {"EXT_texture_avif", Ignored, false, false, kOtherImage,
     "`gltf-transform png --formats avif` makes PNG images of AVIF images"},
    {"EXT_texture_webp", Read},
    {"KHR_animation_pointer", Ignored, true, false,
     "animates properties other than transforms and weights", ""},
    {"KHR_draco_mesh_compression", Read},
    {"KHR_lights_punctual", Read},
    {"KHR_materials_anisotropy", Ignored, true, false, kShiny, ""},
    {"KHR_materials_clearcoat", Approximated, true, false, "reflects diffusely as without the coat",
     ""},
    {"KHR_materials_diffuse_transmission", Ignored, false, true,
     "no light shines through the surface",
     "alphaMode BLEND with an alpha below 1 lets light through"},
    {"KHR_materials_dispersion", Ignored, true, false, kShiny, ""},
    {"KHR_materials_emissive_strength", Read},
    {"KHR_materials_ior", Approximated, true, false, "is read as an index of refraction of 1.5",
     ""},
    {"KHR_materials_iridescence", Ignored, true, false, kShiny, ""},
    {"KHR_materials_pbrSpecularGlossiness", Approximated, true, false,
     "is converted to a metallic-roughness material", ""},
    {"KHR_materials_sheen", Approximated, true, false, "reflects diffusely as without the sheen",
     ""},
    {"KHR_materials_specular", Approximated, true, false,
     "reflects 4 % specularly, as without the extension", ""},
    {"KHR_materials_subsurface", Approximated, true, false,
     "reflects diffusely as without scattering", ""},
    {"KHR_materials_transmission", Approximated, true, false,
     "light shines straight through, as through holes", ""},
    {"KHR_materials_unlit", Read},
    {"KHR_materials_variants", Ignored, true, false, "the default materials are read", ""},
    {"KHR_materials_volume", Ignored, false, true, "light that shines through is not absorbed", ""},
    {"KHR_mesh_quantization", Read},
    {"KHR_meshopt_compression", Ignored, false, true, "the plain buffer views are read",
     "export with EXT_meshopt_compression"},
    {"KHR_node_visibility", Read},
    {"KHR_techniques_webgl", Ignored, false, true, "shaders are not read",
     "`gltf-pipeline -i IN.glb -o OUT.glb` turns them into materials"},
    {"KHR_texture_basisu", Ignored, true, false, kOtherImage, ""},
    {"KHR_texture_transform", Read},
    {"KHR_xmp", Ignored, true, false, kData, ""},
    {"KHR_xmp_json_ld", Ignored, true, false, kData, ""},
    {"MSFT_lod", Ignored, true, false, "the most detailed level is read", ""},
    {"MSFT_texture_dds", Ignored, false, false, kOtherImage,
     "export the images as PNG or JPEG files"},
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
