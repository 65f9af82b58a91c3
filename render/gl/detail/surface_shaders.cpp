// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/detail/shader_texts.h>

namespace tetralight::detail {

const char* const kInstanceText = R"(
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
layout(std430, binding = 6) readonly buffer Instances { Instance instances[]; };

struct Material {
    vec4 base_color;
    vec4 emission;
    vec4 factors;
    uvec4 textures;
    vec4 uv_rows[8];
    uvec4 alpha_mode;
};
layout(std430, binding = 7) readonly buffer Materials { Material materials[]; };

layout(binding = 0) uniform sampler2D base_color_texture;
layout(binding = 1) uniform sampler2D factors_texture;
layout(binding = 2) uniform sampler2D emission_texture;

// What a texture's transform makes of UVs (w = 1) or of their derivatives (w = 0).
vec2 transformed(uint material, int use, vec4 uvs, float w) {
    uint set = use == 3 ? materials[material].alpha_mode.y : materials[material].textures[use];
    vec3 uv = vec3(set == 1u ? uvs.xy : uvs.zw, w);
    return vec2(dot(materials[material].uv_rows[2 * use].xyz, uv),
                dot(materials[material].uv_rows[2 * use + 1].xyz, uv));
}

vec2 image_uv(uint material, int use, vec4 uvs) {
    return transformed(material, use, uvs, 1.0);
}
)";

const char* const kSurfaceVertexText = R"(
layout(location = 0) in vec3 mesh_position;
layout(location = 1) in vec3 mesh_normal;
layout(location = 2) in vec4 mesh_uvs;
layout(location = 3) in vec4 mesh_color;
layout(location = 4) in vec2 mesh_lightmap_uv;
layout(location = 5) in vec4 mesh_tangent;
struct LightmapPlace {
    vec4 rectangle;
    vec4 page;
};
layout(std430, binding = 10) readonly buffer LightmapPlaces { LightmapPlace lightmap_places[]; };
layout(location = 0) uniform mat4 clip_from_space;
layout(location = 1) uniform uint first_instance;
invariant gl_Position;
out vec3 position;
out vec3 normal;
out vec4 uvs;
out vec4 color;
out vec2 lightmap_uv;
out vec4 tangent;
flat out vec3 lightmap_page;  // page, scale of its halves, 1 = light for normal maps
flat out uint instance;

void main() {
    instance = first_instance + uint(gl_InstanceID);
    vec4 row_x = instances[instance].rows[0];
    vec4 row_y = instances[instance].rows[1];
    vec4 row_z = instances[instance].rows[2];
    vec4 place = vec4(mesh_position, 1.0);
    position = vec3(dot(row_x, place), dot(row_y, place), dot(row_z, place));
    gl_Position = clip_from_space * vec4(position, 1.0);
    vec3 x_axis = vec3(row_x.x, row_y.x, row_z.x);
    vec3 y_axis = vec3(row_x.y, row_y.y, row_z.y);
    vec3 z_axis = vec3(row_x.z, row_y.z, row_z.z);
    normal = dot(mesh_normal, mesh_normal) == 0.0
                 ? vec3(0.0)
                 : tetralight_instance_normal(x_axis, y_axis, z_axis, mesh_normal);
    tangent.xyz = mesh_tangent.x * x_axis + mesh_tangent.y * y_axis + mesh_tangent.z * z_axis;
    bool is_mirrored = dot(x_axis, cross(y_axis, z_axis)) < 0.0;
    tangent.w = is_mirrored ? -mesh_tangent.w : mesh_tangent.w;
    uvs = mesh_uvs;
    color = mesh_color;
    lightmap_uv = vec2(0.0);
    lightmap_page = vec3(0.0);
    if (instances[instance].use == 4u) {
        lightmap_uv = tetralight_page_uv(lightmap_places[instance].rectangle, mesh_lightmap_uv);
        lightmap_page = lightmap_places[instance].page.xyz;
    }
}
)";

const char* const kSurfaceInputText = R"(
in vec3 position;
in vec3 normal;
in vec4 uvs;
in vec4 color;
in vec2 lightmap_uv;
in vec4 tangent;
flat in vec3 lightmap_page;
flat in uint instance;
)";

const char* const kDepthText = R"(
void main() {}
)";

// Blended surfaces are drawn only into shadow maps. Their alpha becomes a fraction of each block of
// 3 x 3 texels, the block that `shadow` averages.
const char* const kMaskedDepthText = R"(
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

const char* const kFrameText = R"(
layout(std140, binding = 1) uniform Frame {
    vec4 eye;  // w = 1: a position; w = 0: a direction, of orthographic cameras
    vec4 right;  // length: what half the width of the picture grows by per metre of depth
    vec4 up;
    vec4 ahead;
    uvec4 counts;  // lights, reflection probes, 1 = box projection, levels of the cubes - 1
    vec4 shadow_color;
    TetralightPackedSh sky;
};
)";

const char* const kSkyVertexText = R"(
out vec2 place;
void main() {
    place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(place, 0.0, 1.0);
}
)";

const char* const kSkyText = R"(
in vec2 place;
out vec4 radiance;
void main() {
    vec3 direction = normalize(ahead.xyz + place.x * right.xyz + place.y * up.xyz);
    radiance = vec4(max(tetralight_sample_sh9(sky, direction), vec3(0.0)), 1.0);
}
)";

}  // namespace tetralight::detail
