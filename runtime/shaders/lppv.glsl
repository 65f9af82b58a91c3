// SPDX-License-Identifier: Apache-2.0
// Samples proxy volumes. The C++ twins are lppv/lppv_texture.h and lppv/lppv_atlas.h, whose structs
// have the layout of these structs in std140 and constant buffers. Textures need the linear filter,
// clamped edges and one level. In HLSL the sampler follows its texture:
//     tetralight_sample_lppv_4(volume, volume_sampler, constants, world_position)
//
//     TetralightPackedSh sh = tetralight_sample_lppv_4(volume, constants, world_position);
//     vec3 light = tetralight_sample_sh9(sh, normal);
//     color = albedo * max(light, 0.0);   // light is irradiance / pi

struct TetralightLppvConstants {
    mat4 local_from_world;
    vec4 params;  // enabled, in local space, width of a texel, 0
    vec4 low;
    vec4 size_inverse;
    vec4 shb_r;
    vec4 shb_g;
    vec4 shb_b;
    vec4 shc;
};

struct TetralightLppvAtlasConstants {
    mat4 texture_from_world;
    vec4 low;
    vec4 high;
    vec4 shb_r;
    vec4 shb_g;
    vec4 shb_b;
    vec4 shc;
};

// Coordinates in the volume: 0 to 1 from edge to edge of the outer texels.
vec3 tetralight_lppv_coordinates(TetralightLppvConstants c, vec3 world_position) {
    vec4 world = vec4(world_position.x, world_position.y, world_position.z, 1.0f);
    vec4 local = c.params.y == 1.0f ? TETRALIGHT_MUL(c.local_from_world, world) : world;
    return (local.xyz - c.low.xyz) * c.size_inverse.xyz;
}

// Coordinates in the first slab, with x at least half a texel inside the slab. The sampler clamps y
// and z.
vec3 tetralight_lppv_slab(TetralightLppvConstants c, vec3 world_position, float slabs) {
    vec3 uvw = tetralight_lppv_coordinates(c, world_position);
    uvw.x = clamp(uvw.x / slabs, 0.5f * c.params.z, 1.0f / slabs - 0.5f * c.params.z);
    return uvw;
}

// Coordinates in the first slab of an atlas, clamped to the centers of the volume's outer texels.
vec3 tetralight_atlas_slab(TetralightLppvAtlasConstants c, vec3 world_position) {
    vec4 world = vec4(world_position.x, world_position.y, world_position.z, 1.0f);
    return clamp(TETRALIGHT_MUL(c.texture_from_world, world).xyz, c.low.xyz, c.high.xyz);
}

// A slab of a texture at coordinates in the first slab.
vec4 tetralight_slab(TETRALIGHT_TEXTURE_3D(slabs), vec3 uvw, float slab, float slab_count) {
    return TETRALIGHT_SAMPLE_3D(slabs, uvw + vec3(slab / slab_count, 0.0f, 0.0f));
}

// Four slabs store s0 in w of SHA, and band 2 is constant for the object. The result has s0 - s6 in
// w of SHA; SHB has 3 s6 in z.
TetralightPackedSh tetralight_four_slabs(TETRALIGHT_TEXTURE_3D(slabs), vec3 uvw, vec4 shb_r,
                                         vec4 shb_g, vec4 shb_b, vec4 shc) {
    float third = 1.0f / 3.0f;
    TetralightPackedSh sh;
    sh.sha_r = tetralight_slab(TETRALIGHT_PASS_3D(slabs), uvw, 0.0f, 4.0f);
    sh.sha_g = tetralight_slab(TETRALIGHT_PASS_3D(slabs), uvw, 1.0f, 4.0f);
    sh.sha_b = tetralight_slab(TETRALIGHT_PASS_3D(slabs), uvw, 2.0f, 4.0f);
    sh.sha_r.w = sh.sha_r.w - third * shb_r.z;
    sh.sha_g.w = sh.sha_g.w - third * shb_g.z;
    sh.sha_b.w = sh.sha_b.w - third * shb_b.z;
    sh.shb_r = shb_r;
    sh.shb_g = shb_g;
    sh.shb_b = shb_b;
    sh.shc = shc;
    return sh;
}

TetralightPackedSh tetralight_seven_slabs(TETRALIGHT_TEXTURE_3D(slabs), vec3 uvw) {
    TetralightPackedSh sh;
    sh.sha_r = tetralight_slab(TETRALIGHT_PASS_3D(slabs), uvw, 0.0f, 7.0f);
    sh.sha_g = tetralight_slab(TETRALIGHT_PASS_3D(slabs), uvw, 1.0f, 7.0f);
    sh.sha_b = tetralight_slab(TETRALIGHT_PASS_3D(slabs), uvw, 2.0f, 7.0f);
    sh.shb_r = tetralight_slab(TETRALIGHT_PASS_3D(slabs), uvw, 3.0f, 7.0f);
    sh.shb_g = tetralight_slab(TETRALIGHT_PASS_3D(slabs), uvw, 4.0f, 7.0f);
    sh.shb_b = tetralight_slab(TETRALIGHT_PASS_3D(slabs), uvw, 5.0f, 7.0f);
    sh.shc = tetralight_slab(TETRALIGHT_PASS_3D(slabs), uvw, 6.0f, 7.0f);
    return sh;
}

// The light in a texture of four slabs, with band 2 from the constants.
TetralightPackedSh tetralight_sample_lppv_4(TETRALIGHT_TEXTURE_3D(slabs), TetralightLppvConstants c,
                                            vec3 world_position) {
    vec3 uvw = tetralight_lppv_slab(c, world_position, 4.0f);
    return tetralight_four_slabs(TETRALIGHT_PASS_3D(slabs), uvw, c.shb_r, c.shb_g, c.shb_b, c.shc);
}

// The light in a texture of seven slabs.
TetralightPackedSh tetralight_sample_lppv_7(TETRALIGHT_TEXTURE_3D(slabs), TetralightLppvConstants c,
                                            vec3 world_position) {
    return tetralight_seven_slabs(TETRALIGHT_PASS_3D(slabs),
                                  tetralight_lppv_slab(c, world_position, 7.0f));
}

// The occlusion in a texture of four slabs: four channels, 1 = lit.
vec4 tetralight_sample_lppv_occlusion(TETRALIGHT_TEXTURE_3D(slabs), TetralightLppvConstants c,
                                      vec3 world_position) {
    vec3 uvw = tetralight_lppv_coordinates(c, world_position);
    uvw.x = max(0.25f * uvw.x + 0.75f, 0.75f + 0.5f * c.params.z);
    return TETRALIGHT_SAMPLE_3D(slabs, uvw);
}

TetralightPackedSh tetralight_sample_lppv_atlas_4(TETRALIGHT_TEXTURE_3D(atlas),
                                                  TetralightLppvAtlasConstants c,
                                                  vec3 world_position) {
    vec3 uvw = tetralight_atlas_slab(c, world_position);
    return tetralight_four_slabs(TETRALIGHT_PASS_3D(atlas), uvw, c.shb_r, c.shb_g, c.shb_b, c.shc);
}

TetralightPackedSh tetralight_sample_lppv_atlas_7(TETRALIGHT_TEXTURE_3D(atlas),
                                                  TetralightLppvAtlasConstants c,
                                                  vec3 world_position) {
    return tetralight_seven_slabs(TETRALIGHT_PASS_3D(atlas),
                                  tetralight_atlas_slab(c, world_position));
}

vec4 tetralight_sample_lppv_atlas_occlusion(TETRALIGHT_TEXTURE_3D(atlas),
                                            TetralightLppvAtlasConstants c, vec3 world_position) {
    vec3 uvw = tetralight_atlas_slab(c, world_position);
    return tetralight_slab(TETRALIGHT_PASS_3D(atlas), uvw, 3.0f, 4.0f);
}
