// SPDX-License-Identifier: Apache-2.0
// Light of probes at a surface. The C++ twins are probes/packed_sh.h and runtime/probe_shading.h.

// Irradiance / pi of one object or instance, written by pack_sh and pack_instances:
//   E(n)/pi = dot(sha, (n, 1)) + dot(shb, (xy, yz, zz, zx)) + shc (xx - yy)
struct TetralightPackedSh {
    vec4 sha_r;
    vec4 sha_g;
    vec4 sha_b;
    vec4 shb_r;
    vec4 shb_g;
    vec4 shb_b;
    vec4 shc;
};

// Its first two bands for red, green and blue: dot(sha, (n, 1)).
struct TetralightPackedSh4 {
    vec4 sha_r;
    vec4 sha_g;
    vec4 sha_b;
};

// Irradiance / pi at a unit normal. Times albedo it is the diffuse exitant radiance. It can be
// negative due to ringing: clamp the sum of all light at 0.
vec3 tetralight_sample_sh9(TetralightPackedSh sh, vec3 normal) {
    vec4 linear_part = vec4(normal.x, normal.y, normal.z, 1.0f);
    vec4 products = vec4(normal.x * normal.y, normal.y * normal.z, normal.z * normal.z,
                         normal.z * normal.x);
    float square = normal.x * normal.x - normal.y * normal.y;
    return vec3(dot(sh.sha_r, linear_part) + dot(sh.shb_r, products) + sh.shc.x * square,
                dot(sh.sha_g, linear_part) + dot(sh.shb_g, products) + sh.shc.y * square,
                dot(sh.sha_b, linear_part) + dot(sh.shb_b, products) + sh.shc.z * square);
}

// The first two bands of packed light. sha.w of packed light is s0 - s6: s6 = shb.z / 3 is added.
TetralightPackedSh4 tetralight_first_bands(TetralightPackedSh sh) {
    float third = 1.0f / 3.0f;
    TetralightPackedSh4 bands;
    bands.sha_r = sh.sha_r + vec4(0.0f, 0.0f, 0.0f, third * sh.shb_r.z);
    bands.sha_g = sh.sha_g + vec4(0.0f, 0.0f, 0.0f, third * sh.shb_g.z);
    bands.sha_b = sh.sha_b + vec4(0.0f, 0.0f, 0.0f, third * sh.shb_b.z);
    return bands;
}

// Irradiance / pi of two bands: three dot products, for distant or small objects.
vec3 tetralight_sample_sh4(TetralightPackedSh4 sh, vec3 normal) {
    vec4 linear_part = vec4(normal.x, normal.y, normal.z, 1.0f);
    return vec3(dot(sh.sha_r, linear_part), dot(sh.sha_g, linear_part), dot(sh.sha_b, linear_part));
}

// Adds one layer of light (a light, the sky) times its weight for red, green and blue.
TetralightPackedSh tetralight_add_layer(TetralightPackedSh sum, TetralightPackedSh layer,
                                        vec3 weight) {
    TetralightPackedSh added;
    added.sha_r = sum.sha_r + layer.sha_r * weight.x;
    added.sha_g = sum.sha_g + layer.sha_g * weight.y;
    added.sha_b = sum.sha_b + layer.sha_b * weight.z;
    added.shb_r = sum.shb_r + layer.shb_r * weight.x;
    added.shb_g = sum.shb_g + layer.shb_g * weight.y;
    added.shb_b = sum.shb_b + layer.shb_b * weight.z;
    added.shc = vec4(sum.shc.x + layer.shc.x * weight.x, sum.shc.y + layer.shc.y * weight.y,
                     sum.shc.z + layer.shc.z * weight.z, 1.0f);
    return added;
}

// Visibility of a light at an object, 1 = lit: the light's channel of the probes' occlusion. 1 for
// a light without a channel (-1).
float tetralight_probe_occlusion(vec4 occlusion, int channel) {
    if (channel == 0) return occlusion.x;
    if (channel == 1) return occlusion.y;
    if (channel == 2) return occlusion.z;
    return channel == 3 ? occlusion.w : 1.0f;
}

// The shadow of a light with a limited shadow map: `shadow` (1 = lit) from the map, `occlusion` of
// the static scene from the probes. `fade` is 0 inside the range of the map and 1 outside.
float tetralight_mix_occlusion(float shadow, float occlusion, float fade) {
    return mix(min(shadow, occlusion), occlusion, fade);
}

// World-space unit normal of an instance whose transform has these axes (the first three columns of
// world_from_instance), for scales between 1e-9 and 1e9, also mirrored. A singular transform
// returns the normal unchanged.
vec3 tetralight_instance_normal(vec3 x_axis, vec3 y_axis, vec3 z_axis, vec3 normal) {
    vec3 transformed = cross(y_axis, z_axis) * normal.x + cross(z_axis, x_axis) * normal.y +
                  cross(x_axis, y_axis) * normal.z;
    if (dot(x_axis, cross(y_axis, z_axis)) < 0.0f) transformed = -transformed;
    float square = dot(transformed, transformed);
    return square > 0.0f ? transformed * inversesqrt(square) : normal;
}

// The unit normal of a surface with its normal map, in the space of its unit normal. `tangent.xyz`
// points along u of the map; w is -1 if y points to cross(tangent, normal), as in glTF, and times
// -1 for instances that are mirrored. `texel` is red and green of the map, whose z is made from
// them; `scale` is that of glTF. Twin: bake/scene/mapped_normal.h.
vec3 tetralight_mapped_normal(vec3 normal, vec4 tangent, vec2 texel, float scale) {
    vec3 along = vec3(tangent.x, tangent.y, tangent.z);
    along = along - dot(along, normal) * normal;
    float square = dot(along, along);
    if (!(square > 0.0f)) return normal;
    along = along * inversesqrt(square);
    vec3 across = cross(normal, along) * (tangent.w < 0.0f ? -1.0f : 1.0f);
    vec2 xy = texel * 2.0f - vec2(1.0f, 1.0f);
    float z = sqrt(max(0.0f, 1.0f - dot(xy, xy)));
    vec3 mapped = (along * xy.x + across * xy.y) * scale + normal * z;
    square = dot(mapped, mapped);
    return square > 0.0f ? mapped * inversesqrt(square) : normal;
}

// The direction of most light: that of the second band.
vec3 tetralight_dominant_direction(TetralightPackedSh sh) {
    vec4 sum = sh.sha_r * 0.2126f + sh.sha_g * 0.7152f + sh.sha_b * 0.0722f;
    vec3 direction = vec3(sum.x, sum.y, sum.z);
    float square = dot(direction, direction);
    return square > 0.0f ? direction * inversesqrt(square) : vec3(0.0f, 1.0f, 0.0f);
}

// Irradiance of the directional light in this direction that has this second band, on a surface
// that faces it.
vec3 tetralight_dominant_irradiance(TetralightPackedSh sh, vec3 direction) {
    vec4 along = vec4(direction.x, direction.y, direction.z, 0.0f);
    vec3 irradiance = vec3(dot(sh.sha_r, along), dot(sh.sha_g, along), dot(sh.sha_b, along));
    return max(irradiance, vec3(0.0f, 0.0f, 0.0f)) * 6.2831853f;
}

// Specular radiance of a light for each unit of its irradiance on a surface that faces it: GGX with
// glTF's roughness. All directions have length 1.
vec3 tetralight_specular_reflection(vec3 normal, vec3 to_light, vec3 to_eye, vec3 f0,
                                    float roughness) {
    vec3 between = to_light + to_eye;
    float square = dot(between, between);
    float light_cosine = dot(normal, to_light);
    if (!(light_cosine > 0.0f) || !(square > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
    vec3 halfway = between * inversesqrt(square);
    float eye_cosine = max(dot(normal, to_eye), 0.0001f);
    float half_cosine = dot(normal, halfway);
    float a = max(roughness * roughness, 0.002f);
    float a2 = a * a;
    float spread = half_cosine * half_cosine * (a2 - 1.0f) + 1.0f;
    float facets = a2 / (3.1415927f * spread * spread);
    float masking = light_cosine * sqrt(eye_cosine * eye_cosine * (1.0f - a2) + a2) +
                    eye_cosine * sqrt(light_cosine * light_cosine * (1.0f - a2) + a2);
    float grazing = 1.0f - max(dot(to_eye, halfway), 0.0f);
    float grazing_2 = grazing * grazing;
    float fresnel = grazing_2 * grazing_2 * grazing;
    vec3 mirrored = f0 + (vec3(1.0f, 1.0f, 1.0f) - f0) * fresnel;
    return mirrored * (facets * 0.5f / masking * light_cosine);
}
