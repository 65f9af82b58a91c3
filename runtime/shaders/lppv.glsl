// SPDX-License-Identifier: Apache-2.0
// Sampling proxy volumes: the twin of lppv/lppv_texture.h and lppv/lppv_atlas.h, whose structs these
// are in std140. For GLSL 3.30, 4.50 and ES 3.00 and later, to be put behind #version (and, in ES,
// `precision highp float; precision highp sampler3D;`). Textures: linear filter, edges clamped, one
// level.
//
//     vec3 light = evaluate_sh9(lppv_four_slabs(volume, constants, world_position), normal);
//     color = albedo * max(light, 0.0);   // light is irradiance / pi

struct PackedSh {
    vec4 sha_r, sha_g, sha_b;
    vec4 shb_r, shb_g, shb_b;
    vec4 shc;
};

struct LppvConstants {
    mat4 local_from_world;
    vec4 params;  // enabled, in local space, width of a texel, 0
    vec4 low;
    vec4 size_inverse;
    vec4 shb_r, shb_g, shb_b, shc;
};

struct LppvAtlasConstants {
    mat4 texture_from_world;
    vec4 low;
    vec4 high;
    vec4 shb_r, shb_g, shb_b, shc;
};

// Irradiance / pi of a surface with a unit normal.
vec3 evaluate_sh9(PackedSh sh, vec3 n) {
    vec4 linear = vec4(n, 1.0);
    vec4 quadratic = vec4(n.x * n.y, n.y * n.z, n.z * n.z, n.z * n.x);
    float square = n.x * n.x - n.y * n.y;
    return vec3(dot(sh.sha_r, linear) + dot(sh.shb_r, quadratic),
                dot(sh.sha_g, linear) + dot(sh.shb_g, quadratic),
                dot(sh.sha_b, linear) + dot(sh.shb_b, quadratic)) +
           sh.shc.rgb * square;
}

// 0 to 1 from edge to edge of the volume's outer texels.
vec3 lppv_volume_coordinates(LppvConstants c, vec3 world_position) {
    vec3 place = c.params.y == 1.0 ? (c.local_from_world * vec4(world_position, 1.0)).xyz
                                   : world_position;
    return (place - c.low.xyz) * c.size_inverse.xyz;
}

// Coordinates in the first slab, half a texel from the slab's sides; y and z are the sampler's to
// clamp.
vec3 lppv_slab_coordinates(LppvConstants c, vec3 world_position, float slabs) {
    vec3 uvw = lppv_volume_coordinates(c, world_position);
    uvw.x = clamp(uvw.x / slabs, 0.5 * c.params.z, 1.0 / slabs - 0.5 * c.params.z);
    return uvw;
}

// Bands 0 and 1 whose w is s0, and band 2: SHB has 3 s6 as z, and SHA is to hold s0 - s6.
PackedSh lppv_with_band_2(vec4 sha_r, vec4 sha_g, vec4 sha_b, vec4 shb_r, vec4 shb_g, vec4 shb_b,
                          vec4 shc) {
    vec3 s6 = vec3(shb_r.z, shb_g.z, shb_b.z) / 3.0;
    return PackedSh(sha_r - vec4(0.0, 0.0, 0.0, s6.r), sha_g - vec4(0.0, 0.0, 0.0, s6.g),
                    sha_b - vec4(0.0, 0.0, 0.0, s6.b), shb_r, shb_g, shb_b, shc);
}

PackedSh lppv_four_slabs(sampler3D volume, LppvConstants c, vec3 world_position) {
    vec3 uvw = lppv_slab_coordinates(c, world_position, 4.0);
    vec3 slab = vec3(0.25, 0.0, 0.0);
    return lppv_with_band_2(textureLod(volume, uvw, 0.0), textureLod(volume, uvw + slab, 0.0),
                            textureLod(volume, uvw + 2.0 * slab, 0.0), c.shb_r, c.shb_g, c.shb_b,
                            c.shc);
}

// Four channels, 1 = lit.
vec4 lppv_occlusion(sampler3D volume, LppvConstants c, vec3 world_position) {
    vec3 uvw = lppv_volume_coordinates(c, world_position);
    uvw.x = max(0.25 * uvw.x + 0.75, 0.75 + 0.5 * c.params.z);
    return textureLod(volume, uvw, 0.0);
}

PackedSh lppv_seven_slabs(sampler3D volume, LppvConstants c, vec3 world_position) {
    vec3 uvw = lppv_slab_coordinates(c, world_position, 7.0);
    vec3 slab = vec3(1.0 / 7.0, 0.0, 0.0);
    return PackedSh(
        textureLod(volume, uvw, 0.0), textureLod(volume, uvw + slab, 0.0),
        textureLod(volume, uvw + 2.0 * slab, 0.0), textureLod(volume, uvw + 3.0 * slab, 0.0),
        textureLod(volume, uvw + 4.0 * slab, 0.0), textureLod(volume, uvw + 5.0 * slab, 0.0),
        textureLod(volume, uvw + 6.0 * slab, 0.0));
}

// Coordinates in the first slab of an atlas, clamped to the middles of the volume's outer texels.
vec3 lppv_atlas_coordinates(LppvAtlasConstants c, vec3 world_position) {
    return clamp((c.texture_from_world * vec4(world_position, 1.0)).xyz, c.low.xyz, c.high.xyz);
}

PackedSh lppv_atlas_four_slabs(sampler3D atlas, LppvAtlasConstants c, vec3 world_position) {
    vec3 uvw = lppv_atlas_coordinates(c, world_position);
    vec3 slab = vec3(0.25, 0.0, 0.0);
    return lppv_with_band_2(textureLod(atlas, uvw, 0.0), textureLod(atlas, uvw + slab, 0.0),
                            textureLod(atlas, uvw + 2.0 * slab, 0.0), c.shb_r, c.shb_g, c.shb_b,
                            c.shc);
}

vec4 lppv_atlas_occlusion(sampler3D atlas, LppvAtlasConstants c, vec3 world_position) {
    vec3 uvw = lppv_atlas_coordinates(c, world_position);
    return textureLod(atlas, uvw + vec3(0.75, 0.0, 0.0), 0.0);
}

PackedSh lppv_atlas_seven_slabs(sampler3D atlas, LppvAtlasConstants c, vec3 world_position) {
    vec3 uvw = lppv_atlas_coordinates(c, world_position);
    vec3 slab = vec3(1.0 / 7.0, 0.0, 0.0);
    return PackedSh(
        textureLod(atlas, uvw, 0.0), textureLod(atlas, uvw + slab, 0.0),
        textureLod(atlas, uvw + 2.0 * slab, 0.0), textureLod(atlas, uvw + 3.0 * slab, 0.0),
        textureLod(atlas, uvw + 4.0 * slab, 0.0), textureLod(atlas, uvw + 5.0 * slab, 0.0),
        textureLod(atlas, uvw + 6.0 * slab, 0.0));
}
