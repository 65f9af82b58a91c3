// SPDX-License-Identifier: Apache-2.0
// Samples lightmaps. The C++ twin is lightmap/sample_lightmap.h; lightmap/lightmap_texture.h makes
// the textures: arrays of RGBA16F pages with the linear filter, clamped edges and one level.
// `scale` is that of LightmapInfo. `uv_page` is uv * rectangle.scale + rectangle.offset with the
// unwrapped uv (TEXCOORD_1) of the mesh. In HLSL the sampler follows its texture:
//     tetralight_lightmap_irradiance(pages, pages_sampler, uv_page, page, scale)
//
//     vec3 irradiance = tetralight_lightmap_irradiance(pages, uv_page, page, scale);
//     color = albedo / pi * irradiance;

// Where the unwrapped uv of an instance lies in its page. `rectangle` is scale, then offset.
vec2 tetralight_page_uv(vec4 rectangle, vec2 uv) {
    return uv * rectangle.xy + rectangle.zw;
}

// Irradiance on the normal that the page was baked for, from section `irradiance`, whose
// layers are the pages.
vec3 tetralight_lightmap_irradiance(TETRALIGHT_TEXTURE_ARRAY(pages), vec2 uv_page, float page,
                                    float scale) {
    return TETRALIGHT_SAMPLE_ARRAY(pages, uv_page, page).xyz * scale;
}

// How much of the light of each occlusion channel the texels see, from section `shadow_mask` as an
// RGBA8 texture: the shadows of static objects.
vec4 tetralight_lightmap_shadow_mask(TETRALIGHT_TEXTURE_ARRAY(masks), vec2 uv_page, float page) {
    return TETRALIGHT_SAMPLE_ARRAY(masks, uv_page, page);
}

// How open the surroundings are, from section `ambient_occlusion` as an R8 texture. The irradiance
// does not include it.
float tetralight_lightmap_ambient_occlusion(TETRALIGHT_TEXTURE_ARRAY(maps), vec2 uv_page,
                                            float page) {
    return TETRALIGHT_SAMPLE_ARRAY(maps, uv_page, page).x;
}

// Twin of subtract_shadow (runtime/shade.h): the real-time shadow of a light that is in the baked
// light.
vec3 tetralight_subtract_shadow(vec3 baked, vec3 direct, float lit, vec3 shadow_color) {
    return min(baked, max(baked - direct * (1.0f - lit), shadow_color));
}

// E(n) / flux of light whose vector is u times its flux, |u| <= 1, on a unit normal near that of the
// surface: the twin of `irradiance_of_unit_flux` (lightmap/directional_light.h).
float tetralight_irradiance_of_unit_flux(vec3 u, vec3 base_normal, vec3 normal) {
    float cosine = dot(u, base_normal);
    float b = 2.0f - cosine;
    float c = max(0.0f, 1.0f - dot(u, u));
    float root = 2.0f * c / (b + sqrt(max(0.0f, b * b - 3.0f * c)));
    float around = clamp(root, 0.0f, max(0.0f, 2.0f * cosine));
    vec3 rest = u - 0.5f * around * base_normal;
    return max(0.0f, 0.25f * around * (1.0f + dot(normal, base_normal))) +
           max(0.0f, dot(normal, rest));
}

// Irradiance of one channel, whose light is its vector, then its flux.
float tetralight_directional_irradiance(vec4 light, vec3 base_normal, vec3 normal) {
    float flux = light.w;
    if (!(flux > 0.0f)) return max(0.0f, dot(normal, light.xyz));
    vec3 u = light.xyz / flux;
    float size = max(1.0f, length(u));
    return flux * size * tetralight_irradiance_of_unit_flux(u / size, base_normal, normal);
}

// Irradiance on a unit normal in world space, as normal maps give, of a surface whose own unit
// normal is `base_normal`, from `make_light_texture`, whose layers are the three channels of each
// page.
vec3 tetralight_lightmap_directional(TETRALIGHT_TEXTURE_ARRAY(light), vec2 uv_page, float page,
                                     float scale, vec3 base_normal, vec3 normal) {
    vec4 red = TETRALIGHT_SAMPLE_ARRAY(light, uv_page, 3.0f * page);
    vec4 green = TETRALIGHT_SAMPLE_ARRAY(light, uv_page, 3.0f * page + 1.0f);
    vec4 blue = TETRALIGHT_SAMPLE_ARRAY(light, uv_page, 3.0f * page + 2.0f);
    return scale * vec3(tetralight_directional_irradiance(red, base_normal, normal),
                        tetralight_directional_irradiance(green, base_normal, normal),
                        tetralight_directional_irradiance(blue, base_normal, normal));
}

// What the irradiance on the surface is multiplied with to give that on a normal, with one vector u
// for all channels: the twin of `mono_ratio`.
float tetralight_mono_ratio(vec3 u, vec3 base_normal, vec3 normal) {
    float least = 1.0f / 256.0f;
    return (tetralight_irradiance_of_unit_flux(u, base_normal, normal) + least) /
           (tetralight_irradiance_of_unit_flux(u, base_normal, base_normal) + least);
}
