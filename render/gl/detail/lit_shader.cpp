// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/detail/shader_texts.h>

namespace tetralight::detail {

const char* const kLitText = R"(
struct Light {
    vec4 position;
    vec4 direction;
    vec4 intensity;
    vec4 shape;
    ivec4 shadow;
    ivec4 reach;  // x: lights moving objects; y: LightmapShadow of render/scene_light.h
};
layout(std430, binding = 8) readonly buffer PunctualLights { Light lights[]; };
struct ShadowLayer {
    mat4 clip_from_space;
    vec4 texel;
};
layout(std430, binding = 9) readonly buffer ShadowLayers { ShadowLayer shadow_layers[]; };
layout(std140, binding = 2) uniform Proxy { TetralightLppvConstants proxy; };
layout(binding = 3) uniform sampler2DArrayShadow shadow_maps;
layout(binding = 4) uniform sampler3D proxy_light;
layout(binding = 5) uniform sampler3D proxy_occlusion;
layout(binding = 6) uniform sampler2DArray lightmap_pages;
layout(binding = 7) uniform sampler2D normal_map;
layout(binding = 8) uniform sampler2DArray lightmap_directions;
layout(binding = 9) uniform sampler2DArray lightmap_shadow_masks;
layout(binding = 10) uniform sampler2DArray lightmap_ambient_occlusion;
out vec4 radiance;

const float kPi = 3.14159265;

float saturate(float x) { return clamp(x, 0.0, 1.0); }

// Twins of probes/light.cpp.
float falloff(Light light, float distance, float square) {
    float ratio = light.position.w > 0.0 ? distance / light.position.w : 0.0;
    int kind = int(light.intensity.w);
    if (kind == 2) return saturate(1.0 - ratio);
    if (kind == 3) {
        float x = ratio * ratio;
        return saturate(1.0 - (x - 0.64) / 0.36) / (1.0 + 25.0 * x);
    }
    float window = saturate(1.0 - ratio * ratio * ratio * ratio);
    return (kind == 1 ? window * window : window) / square;
}

float profile(Light light, vec3 to_light) {
    float cosine = -dot(light.direction.xyz, to_light);
    int kind = int(light.direction.w);
    if (kind == 2) {
        float width = max(0.001, light.shape.x - light.shape.y);
        float ramp = saturate((cosine - light.shape.y) / width);
        return ramp * ramp;
    }
    return kind >= 3 ? max(0.0, cosine) : 1.0;
}

struct Arriving {
    vec3 irradiance;
    vec3 to_light;
};

Arriving illuminate(Light light, vec3 place) {
    if (int(light.direction.w) == 0) return Arriving(light.intensity.xyz, -light.direction.xyz);
    vec3 offset = light.position.xyz - place;
    float distance = length(offset);
    if (!(distance > 0.0)) return Arriving(vec3(0.0), vec3(0.0));
    vec3 to_light = offset / distance;
    float square = distance * distance + light.shape.z / kPi;
    float attenuation = falloff(light, distance, square) * profile(light, to_light);
    return Arriving(light.intensity.xyz * attenuation, to_light);
}

int cube_face(vec3 direction) {
    vec3 size = abs(direction);
    if (size.x >= size.y && size.x >= size.z) return direction.x > 0.0 ? 0 : 1;
    if (size.y >= size.z) return direction.y > 0.0 ? 2 : 3;
    return direction.z > 0.0 ? 4 : 5;
}

// The lit fraction of 3 x 3 texels. The position is moved off the surface by the extent of these
// texels.
float shadow(Light light, int first_layer, vec3 place, vec3 flat_normal, vec3 to_light) {
    if (light.shadow.z == 0) return 1.0;
    int layer = first_layer;
    if (light.shadow.z == 6) layer += cube_face(place - light.position.xyz);
    vec4 texel = shadow_layers[layer].texel;
    float size = texel.x * (texel.y == 1.0 ? distance(place, light.position.xyz) : 1.0);
    float slope = sqrt(saturate(1.0 - dot(flat_normal, to_light) * dot(flat_normal, to_light)));
    vec3 start = place + (flat_normal * (0.5 + 1.5 * slope) + to_light) * size;
    vec4 clip = shadow_layers[layer].clip_from_space * vec4(start, 1.0);
    vec3 at = clip.xyz / clip.w;
    vec2 uv = 0.5 * at.xy + 0.5;
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0))) || at.z > 1.0) return 1.0;
    float step = 1.0 / float(textureSize(shadow_maps, 0).x);
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            sum += texture(shadow_maps, vec4(uv + step * vec2(x, y), layer, at.z));
        }
    }
    return sum / 9.0;
}

// A shading point.
struct ShadingPoint {
    vec3 normal;
    vec3 flat_normal;
    vec3 to_eye;
    vec3 albedo;
    vec3 f0;
    float roughness;
    bool has_specular;
};

vec3 reflected(ShadingPoint point, vec3 to_light, vec3 irradiance) {
    vec3 diffuse = point.albedo * (max(dot(point.normal, to_light), 0.0) / kPi);
    if (!point.has_specular) return irradiance * diffuse;
    vec3 specular = tetralight_specular_reflection(point.normal, to_light, point.to_eye, point.f0,
                                                   point.roughness);
    return irradiance * (diffuse + specular);
}

// `occlusion`: of the probes or of the lightmap.
vec3 direct_light(ShadingPoint point, vec4 occlusion, bool has_lightmap) {
    vec3 sum = vec3(0.0);
    if (instances[instance].direct == 2u) return sum;
    bool moves = instances[instance].direct == 1u;
    for (uint i = 0u; i < counts.x; ++i) {
        Light light = lights[i];
        if (moves && light.reach.x == 0) continue;
        if (has_lightmap && light.reach.y == 2) continue;
        Arriving arriving = illuminate(light, position);
        if (!(dot(point.normal, arriving.to_light) > 0.0)) continue;
        if (!(dot(point.flat_normal, arriving.to_light) > 0.0)) continue;
        bool has_static_shadow =
            light.shadow.w >= 0 && (moves || (has_lightmap && light.reach.y == 1));
        float visible =
            has_static_shadow ? tetralight_probe_occlusion(occlusion, light.shadow.w) : 1.0;
        visible *= shadow(light, has_static_shadow ? light.shadow.y : light.shadow.x, position,
                          point.flat_normal, arriving.to_light);
        sum += reflected(point, arriving.to_light, arriving.irradiance) * visible;
    }
    return sum;
}

TetralightPackedSh no_light() {
    vec4 zero = vec4(0.0);
    return TetralightPackedSh(zero, zero, zero, zero, zero, zero, zero);
}

TetralightPackedSh probe_light(vec3 flat_normal, out vec4 occlusion) {
    occlusion = instances[instance].occlusion;
    uint use = instances[instance].use;
    if (use == 1u) return instances[instance].light;
    if (use == 2u) {
        occlusion *= textureLod(proxy_occlusion, tetralight_lppv_coordinates(proxy, position), 0.0);
        return tetralight_sample_lppv_7(proxy_light, proxy, position);
    }
    bool is_lightmap_back = use == 4u && !gl_FrontFacing;
    if (use == 3u || is_lightmap_back) {
        TetralightCellLocation location = tetralight_locate(position, 0xffffffffu);
        vec3 pushed = tetralight_push_off_surface(position, flat_normal, location,
                                                  tetralight_normal_offset);
        return tetralight_interpolate(tetralight_locate(pushed, location.cell)).sh;
    }
    return no_light();
}

// What a diffuse surface of albedo 1 reflects of the lightmap's light, with the shadows of moving
// objects if they darken it.
vec3 lightmap_light(ShadingPoint point, bool has_normal_map, vec3 base_normal) {
    vec3 irradiance =
        has_normal_map && lightmap_page.z == 1.0
            ? tetralight_lightmap_directional(lightmap_directions, lightmap_uv, lightmap_page.x,
                                              lightmap_page.y, base_normal, point.normal)
            : tetralight_lightmap_irradiance(lightmap_pages, lightmap_uv, lightmap_page.x,
                                             lightmap_page.y);
    vec3 light = irradiance / kPi;
    for (uint i = 0u; i < counts.x; ++i) {
        if (lights[i].reach.x == 0 || lights[i].reach.y != 2 || lights[i].shadow.w < 0) continue;
        Arriving arriving = illuminate(lights[i], position);
        vec3 direct = arriving.irradiance * (max(dot(point.normal, arriving.to_light), 0.0) / kPi);
        float lit = shadow(lights[i], lights[i].shadow.y, position, point.flat_normal,
                           arriving.to_light);
        light = tetralight_subtract_shadow(light, direct, lit, shadow_color.xyz);
    }
    return light * tetralight_lightmap_ambient_occlusion(lightmap_ambient_occlusion, lightmap_uv,
                                                         lightmap_page.x);
}

// The tangent of the triangle, from the UVs of its normal map: `axes_of_uvs` of
// bake/scene/mapped_normal.cpp.
vec4 tangent_of_uvs(vec3 front_normal, vec2 s, vec2 t) {
    vec3 first = dFdx(position), second = dFdy(position);
    float area = s.x * t.y - s.y * t.x;
    if (area == 0.0) return vec4(0.0);
    vec3 along = (t.y * first - s.y * second) * sign(area);
    vec3 across = (t.x * first - s.x * second) * sign(area);
    return vec4(along, dot(cross(front_normal, along), across) < 0.0 ? -1.0 : 1.0);
}

// The normal with its map. Both are on the front of the surface. Derivatives are
// taken of the UVs before they are transformed: helper pixels outside of the triangle may not read the
// buffers that hold the transform.
vec3 mapped_normal(uint material, vec3 front_normal) {
    vec2 s = transformed(material, 3, dFdx(uvs), 0.0), t = transformed(material, 3, dFdy(uvs), 0.0);
    bool has_tangent = dot(tangent.xyz, tangent.xyz) > 0.0;
    vec2 texel = textureGrad(normal_map, image_uv(material, 3, uvs), s, t).rg;
    return tetralight_mapped_normal(front_normal,
                                    has_tangent ? tangent : tangent_of_uvs(front_normal, s, t),
                                    texel, materials[material].factors.w);
}

void main() {
    uint m = instances[instance].material;
    vec4 base = materials[m].base_color * instances[instance].color * color;
    if (materials[m].textures.x != 0u) {
        base *= texture(base_color_texture, image_uv(m, 0, uvs));
    }
    vec2 factors = materials[m].factors.xy * instances[instance].factors.xy;
    if (materials[m].textures.y != 0u) {
        factors *= texture(factors_texture, image_uv(m, 1, uvs)).bg;
    }
    vec3 emission = materials[m].emission.xyz;
    if (materials[m].textures.z != 0u) {
        emission *= texture(emission_texture, image_uv(m, 2, uvs)).rgb;
    }
    radiance.a = materials[m].alpha_mode.x == 2u ? saturate(base.a) : 1.0;
    if (materials[m].textures.w == 1u) {
        radiance.rgb = base.rgb * materials[m].emission.w;
        return;
    }
    vec3 flat_normal = normalize(cross(dFdx(position), dFdy(position)));
    vec3 to_eye = eye.xyz - eye.w * position;
    if (dot(flat_normal, to_eye) < 0.0) flat_normal = -flat_normal;
    vec3 unit_normal = dot(normal, normal) > 0.0
                           ? normalize(gl_FrontFacing ? normal : -normal) : flat_normal;
    if (instances[instance].is_round == 1u || any(isnan(flat_normal))) flat_normal = unit_normal;
    vec3 base_normal = unit_normal;
    bool has_normal_map = materials[m].alpha_mode.y != 0u;
    if (has_normal_map) {
        float side = gl_FrontFacing ? 1.0 : -1.0;
        unit_normal = side * mapped_normal(m, side * base_normal);
    }
    // The diffuse part of glTF's model: bake/scene/surface_color.h.
    ShadingPoint point;
    point.normal = unit_normal;
    point.flat_normal = flat_normal;
    point.to_eye = normalize(to_eye);
    point.f0 = mix(vec3(0.04), base.rgb, factors.x);
    point.roughness = factors.y;
    bool mirrors = reflects_probes();
    point.albedo = base.rgb * ((1.0 - factors.x) * 0.96);
    if (!mirrors) point.albedo += point.f0 * (0.5 * factors.y);
    point.has_specular = instances[instance].factors.z > 0.0;
    vec4 occlusion;
    TetralightPackedSh probe_sh = probe_light(flat_normal, occlusion);
    bool has_lightmap = instances[instance].use == 4u && gl_FrontFacing;
    if (has_lightmap) {
        occlusion = tetralight_lightmap_shadow_mask(lightmap_shadow_masks, lightmap_uv,
                                                    lightmap_page.x);
    }
    vec3 baked = has_lightmap
                     ? lightmap_light(point, has_normal_map, base_normal)
                     : max(tetralight_sample_sh9(probe_sh, unit_normal), vec3(0.0));
    vec3 mirrored = mirrors ? mirrored_light(position, unit_normal, point.to_eye, point.f0, factors.y,
                                             baked)
                            : vec3(0.0);
    baked = baked * point.albedo + mirrored;
    if (point.has_specular && !mirrors) {
        vec3 dominant = tetralight_dominant_direction(probe_sh);
        baked += tetralight_dominant_irradiance(probe_sh, dominant) *
                  tetralight_specular_reflection(unit_normal, dominant, point.to_eye, point.f0,
                                                 factors.y);
    }
    radiance.rgb = emission + baked + direct_light(point, occlusion, has_lightmap);
}
)";

}  // namespace tetralight::detail
