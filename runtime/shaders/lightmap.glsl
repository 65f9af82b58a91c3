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

// Irradiance on a unit normal in world space near the baked one, as normal maps give, from
// `make_light_texture`, whose layers are the three channels of each page.
vec3 tetralight_lightmap_directional(TETRALIGHT_TEXTURE_ARRAY(light), vec2 uv_page, float page,
                                     float scale, vec3 normal) {
    vec3 red = TETRALIGHT_SAMPLE_ARRAY(light, uv_page, 3.0f * page).xyz;
    vec3 green = TETRALIGHT_SAMPLE_ARRAY(light, uv_page, 3.0f * page + 1.0f).xyz;
    vec3 blue = TETRALIGHT_SAMPLE_ARRAY(light, uv_page, 3.0f * page + 2.0f).xyz;
    vec3 irradiance = vec3(dot(normal, red), dot(normal, green), dot(normal, blue)) * scale;
    return max(irradiance, vec3(0.0f, 0.0f, 0.0f));
}
