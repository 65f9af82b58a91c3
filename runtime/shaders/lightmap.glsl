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
