// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/renderer_shaders.h>

#include <array>
#include <string>

#include <tetralight/render/gl/gl.h>

namespace tetralight {
namespace {

constexpr const char* kStructs = R"(
struct Instance {
    vec4 rows[3];
    vec4 color;
    vec4 factors;
    uint use;
    uint direct;
    uint material;
    uint is_round;
    vec4 occlusion;
    TetralightPackedSh light;
};
layout(std430, binding = 5) readonly buffer Instances { Instance instances[]; };

struct Material {
    vec4 base_color;
    vec4 emission;
    vec4 factors;
    uvec4 textures;
    vec4 uv_rows[6];
    uvec4 alpha_mode;
};
layout(std430, binding = 6) readonly buffer Materials { Material materials[]; };

layout(binding = 0) uniform sampler2D base_color_texture;
layout(binding = 1) uniform sampler2D factors_texture;
layout(binding = 2) uniform sampler2D emission_texture;

vec2 image_uv(uint material, int use, vec4 uvs) {
    vec3 uv = vec3(materials[material].textures[use] == 1u ? uvs.xy : uvs.zw, 1.0);
    return vec2(dot(materials[material].uv_rows[2 * use].xyz, uv),
                dot(materials[material].uv_rows[2 * use + 1].xyz, uv));
}
)";

constexpr const char* kVertex = R"(
layout(location = 0) in vec3 mesh_position;
layout(location = 1) in vec3 mesh_normal;
layout(location = 2) in vec4 mesh_uvs;
layout(location = 3) in vec4 mesh_color;
layout(location = 0) uniform mat4 clip_from_space;
layout(location = 1) uniform uint first_instance;
invariant gl_Position;
out vec3 position;
out vec3 normal;
out vec4 uvs;
out vec4 color;
flat out uint instance;

void main() {
    instance = first_instance + uint(gl_InstanceID);
    vec4 row_x = instances[instance].rows[0];
    vec4 row_y = instances[instance].rows[1];
    vec4 row_z = instances[instance].rows[2];
    vec4 place = vec4(mesh_position, 1.0);
    position = vec3(dot(row_x, place), dot(row_y, place), dot(row_z, place));
    gl_Position = clip_from_space * vec4(position, 1.0);
    normal = dot(mesh_normal, mesh_normal) == 0.0
                 ? vec3(0.0)
                 : tetralight_instance_normal(
                       vec3(row_x.x, row_y.x, row_z.x), vec3(row_x.y, row_y.y, row_z.y),
                       vec3(row_x.z, row_y.z, row_z.z), mesh_normal);
    uvs = mesh_uvs;
    color = mesh_color;
}
)";

constexpr const char* kSurface = R"(
in vec3 position;
in vec3 normal;
in vec4 uvs;
in vec4 color;
flat in uint instance;
)";

constexpr const char* kDepth = R"(
void main() {}
)";

// Blended surfaces are drawn into shadow maps alone, where they stop their share of each block of
// 3 x 3 texels: as many as `shadow` averages with equal weights.
constexpr const char* kMaskedDepth = R"(
void main() {
    uint m = instances[instance].material;
    float alpha = materials[m].base_color.a * instances[instance].color.a * color.a;
    if (materials[m].textures.x != 0u) {
        alpha *= textureLod(base_color_texture, image_uv(m, 0, uvs), 0.0).a;
    }
    uvec2 texel = uvec2(gl_FragCoord.xy) % 3u;
    float limit = materials[m].alpha_mode.x == 1u
                      ? materials[m].factors.z
                      : (float(texel.x + 3u * texel.y) + 0.5) / 9.0;
    if (alpha < limit) discard;
}
)";

constexpr const char* kFrame = R"(
layout(std140, binding = 1) uniform Frame {
    vec4 eye;
    vec4 right;  // as long as half the picture is wide at distance 1
    vec4 up;
    vec4 ahead;
    uvec4 counts;  // lights
    vec4 numbers;  // probe normal bias
    TetralightPackedSh sky;
};
)";

constexpr const char* kLit = R"(
struct Lamp {
    vec4 position;
    vec4 direction;
    vec4 intensity;
    vec4 shape;
    ivec4 shadow;
    ivec4 lights_moving;
};
layout(std430, binding = 7) readonly buffer PunctualLights { Lamp lamps[]; };
struct ShadowLayer {
    mat4 clip_from_space;
    vec4 texel;
};
layout(std430, binding = 8) readonly buffer ShadowLayers { ShadowLayer shadow_layers[]; };
layout(std140, binding = 2) uniform Proxy { TetralightLppvConstants proxy; };
layout(binding = 3) uniform sampler2DArrayShadow shadow_maps;
layout(binding = 4) uniform sampler3D proxy_light;
layout(binding = 5) uniform sampler3D proxy_occlusion;
out vec4 radiance;

const float kPi = 3.14159265;

float saturate(float x) { return clamp(x, 0.0, 1.0); }

// Twins of probes/light.cpp.
float falloff(Lamp lamp, float distance, float square) {
    float ratio = lamp.position.w > 0.0 ? distance / lamp.position.w : 0.0;
    int kind = int(lamp.intensity.w);
    if (kind == 2) return saturate(1.0 - ratio);
    if (kind == 3) {
        float x = ratio * ratio;
        return saturate(1.0 - (x - 0.64) / 0.36) / (1.0 + 25.0 * x);
    }
    float window = saturate(1.0 - ratio * ratio * ratio * ratio);
    return (kind == 1 ? window * window : window) / square;
}

float profile(Lamp lamp, vec3 to_light) {
    float cosine = -dot(lamp.direction.xyz, to_light);
    int kind = int(lamp.direction.w);
    if (kind == 2) {
        float width = max(0.001, lamp.shape.x - lamp.shape.y);
        float ramp = saturate((cosine - lamp.shape.y) / width);
        return ramp * ramp;
    }
    return kind >= 3 ? max(0.0, cosine) : 1.0;
}

struct Arriving {
    vec3 irradiance;
    vec3 to_light;
};

Arriving illuminate(Lamp lamp, vec3 place) {
    if (int(lamp.direction.w) == 0) return Arriving(lamp.intensity.xyz, -lamp.direction.xyz);
    vec3 offset = lamp.position.xyz - place;
    float distance = length(offset);
    if (!(distance > 0.0)) return Arriving(vec3(0.0), vec3(0.0));
    vec3 to_light = offset / distance;
    float square = distance * distance + lamp.shape.z / kPi;
    float share = falloff(lamp, distance, square) * profile(lamp, to_light);
    return Arriving(lamp.intensity.xyz * share, to_light);
}

int cube_face(vec3 direction) {
    vec3 size = abs(direction);
    if (size.x >= size.y && size.x >= size.z) return direction.x > 0.0 ? 0 : 1;
    if (size.y >= size.z) return direction.y > 0.0 ? 2 : 3;
    return direction.z > 0.0 ? 4 : 5;
}

// Share of nine texels around that light reaches; the place is moved off the surface by what the
// texels spread over.
float shadow(Lamp lamp, int first_layer, vec3 place, vec3 flat_normal, vec3 to_light) {
    if (lamp.shadow.z == 0) return 1.0;
    int layer = first_layer;
    if (lamp.shadow.z == 6) layer += cube_face(place - lamp.position.xyz);
    vec4 texel = shadow_layers[layer].texel;
    float size = texel.x * (texel.y == 1.0 ? distance(place, lamp.position.xyz) : 1.0);
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

// What lights do at a point.
struct Point {
    vec3 normal;
    vec3 flat_normal;
    vec3 to_eye;
    vec3 albedo;
    vec3 f0;
    float roughness;
    bool mirrors;
};

vec3 reflected(Point point, vec3 to_light, vec3 irradiance) {
    vec3 diffuse = point.albedo * (max(dot(point.normal, to_light), 0.0) / kPi);
    if (!point.mirrors) return irradiance * diffuse;
    vec3 specular = tetralight_specular_reflection(point.normal, to_light, point.to_eye, point.f0,
                                                   point.roughness);
    return irradiance * (diffuse + specular);
}

vec3 direct_light(Point point, vec4 occlusion) {
    vec3 sum = vec3(0.0);
    if (instances[instance].direct == 2u) return sum;
    bool moves = instances[instance].direct == 1u;
    for (uint i = 0u; i < counts.x; ++i) {
        Lamp lamp = lamps[i];
        if (moves && lamp.lights_moving.x == 0) continue;
        Arriving arriving = illuminate(lamp, position);
        if (!(dot(point.normal, arriving.to_light) > 0.0)) continue;
        if (!(dot(point.flat_normal, arriving.to_light) > 0.0)) continue;
        bool has_static_shadow = moves && lamp.shadow.w >= 0;
        float visible =
            has_static_shadow ? tetralight_probe_occlusion(occlusion, lamp.shadow.w) : 1.0;
        visible *= shadow(lamp, has_static_shadow ? lamp.shadow.y : lamp.shadow.x, position,
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
    if (use == 3u) {
        vec3 biased = position + numbers.x * flat_normal;
        return tetralight_interpolate(tetralight_locate(biased, 0xffffffffu)).sh;
    }
    return no_light();
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
    if (dot(flat_normal, eye.xyz - position) < 0.0) flat_normal = -flat_normal;
    vec3 unit_normal = dot(normal, normal) > 0.0
                           ? normalize(gl_FrontFacing ? normal : -normal) : flat_normal;
    if (instances[instance].is_round == 1u || any(isnan(flat_normal))) flat_normal = unit_normal;
    // The diffuse share of glTF's model: bake/scene/surface_color.h.
    Point point;
    point.normal = unit_normal;
    point.flat_normal = flat_normal;
    point.to_eye = normalize(eye.xyz - position);
    point.f0 = mix(vec3(0.04), base.rgb, factors.x);
    point.roughness = factors.y;
    point.albedo = base.rgb * ((1.0 - factors.x) * 0.96) + point.f0 * (0.5 * factors.y);
    point.mirrors = instances[instance].factors.z > 0.0;
    vec4 occlusion;
    TetralightPackedSh light = probe_light(flat_normal, occlusion);
    vec3 probes = point.albedo * max(tetralight_sample_sh9(light, unit_normal), vec3(0.0));
    if (point.mirrors) {
        vec3 dominant = tetralight_dominant_direction(light);
        probes += tetralight_dominant_irradiance(light, dominant) *
                  tetralight_specular_reflection(unit_normal, dominant, point.to_eye, point.f0,
                                                 factors.y);
    }
    radiance.rgb = emission + probes + direct_light(point, occlusion);
}
)";

constexpr const char* kSkyVertex = R"(
out vec2 place;
void main() {
    place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(place, 0.0, 1.0);
}
)";

constexpr const char* kSky = R"(
in vec2 place;
out vec4 radiance;
void main() {
    vec3 direction = normalize(ahead.xyz + place.x * right.xyz + place.y * up.xyz);
    radiance = vec4(max(tetralight_sample_sh9(sky, direction), vec3(0.0)), 1.0);
}
)";

struct StageText {
    const char* name;
    std::initializer_list<ShaderPart> parts;
    std::string text;
};

Result<ShaderProgram> make_program(const StageText& vertex, const StageText& fragment) {
    const ShaderSource sources[] = {
        compose_shader(ShaderLanguage::Glsl450, vertex.parts, {vertex.name, vertex.text}),
        compose_shader(ShaderLanguage::Glsl450, fragment.parts, {fragment.name, fragment.text})};
    const std::array stages{ShaderStage{GL_VERTEX_SHADER, sources[0]},
                            ShaderStage{GL_FRAGMENT_SHADER, sources[1]}};
    return ShaderProgram::create(stages);
}

}  // namespace

Result<RendererShaders> make_renderer_shaders() {
    const std::string structs = kStructs, surface = kSurface, frame = kFrame;
    const StageText vertex{"surface.vert", {ShaderPart::Sh}, structs + kVertex};
    auto depth = make_program(vertex, {"depth.frag", {ShaderPart::Sh}, kDepth});
    if (!depth) return depth.error();
    auto masked = make_program(
        vertex, {"masked_depth.frag", {ShaderPart::Sh}, structs + surface + kMaskedDepth});
    if (!masked) return masked.error();
    auto lit = make_program(
        vertex,
        {"lit.frag", {ShaderPart::Query, ShaderPart::Lppv}, structs + surface + frame + kLit});
    if (!lit) return lit.error();
    auto sky = make_program({"sky.vert", {ShaderPart::Sh}, kSkyVertex},
                            {"sky.frag", {ShaderPart::Sh}, frame + kSky});
    if (!sky) return sky.error();
    return RendererShaders{std::move(*depth), std::move(*masked), std::move(*lit), std::move(*sky)};
}

}  // namespace tetralight
