// SPDX-License-Identifier: Apache-2.0
// The first file of the shader library: the differences between the shading languages. The other
// files follow; sh.glsl must precede lppv.glsl and query*.glsl, and end.glsl must be the last. All
// names begin with tetralight_, Tetralight or TETRALIGHT_. For HLSL this file also defines names of
// GLSL as macros, which end.glsl undefines.
//
// GLSL 3.30 to 4.60 and GLSL ES 3.00 to 3.20 need no macro. For HLSL define TETRALIGHT_HLSL before
// this file. The library reads the volume from buffers, or from textures if TETRALIGHT_TEXTURES is
// defined. This file defines it for GLSL ES, where stages may lack storage buffers, and for GLSL
// before 4.30.
#if defined(TETRALIGHT_CPP)
#define TETRALIGHT_CONST static constexpr
#elif defined(TETRALIGHT_HLSL)
#ifdef TETRALIGHT_TEXTURES
#error "HLSL reads the volume from structured buffers: do not define TETRALIGHT_TEXTURES"
#endif
#define TETRALIGHT_CONST static const
#define vec2 float2
#define vec3 float3
#define vec4 float4
#define uvec4 uint4
#define mat4 float4x4
#define mix lerp
#define inversesqrt rsqrt
#define floatBitsToUint asuint
#define uintBitsToFloat asfloat
#define TETRALIGHT_MUL(matrix, vector) mul(matrix, vector)
#define TETRALIGHT_TEXTURE_3D(name) Texture3D<float4> name, SamplerState name##_sampler
#define TETRALIGHT_PASS_3D(name) name, name##_sampler
#define TETRALIGHT_SAMPLE_3D(name, uvw) name.SampleLevel(name##_sampler, uvw, 0.0f)
#define TETRALIGHT_TEXTURE_ARRAY(name) Texture2DArray<float4> name, SamplerState name##_sampler
#define TETRALIGHT_SAMPLE_ARRAY(name, uv, i) name.SampleLevel(name##_sampler, float3(uv, i), 0.0f)
#define TETRALIGHT_TEXTURE_2D(name) Texture2D<float4> name, SamplerState name##_sampler
#define TETRALIGHT_SAMPLE_2D(name, uv) name.SampleLevel(name##_sampler, uv, 0.0f)
#define TETRALIGHT_CUBE(name) TextureCube<float4> name, SamplerState name##_sampler
#define TETRALIGHT_SAMPLE_CUBE(name, d, level) name.SampleLevel(name##_sampler, d, level)
#define TETRALIGHT_HAS_CUBE_ARRAYS
#define TETRALIGHT_CUBES(name) TextureCubeArray<float4> name, SamplerState name##_sampler
#define TETRALIGHT_PASS_CUBES(name) name, name##_sampler
#define TETRALIGHT_SAMPLE_CUBES(name, d, i, l) name.SampleLevel(name##_sampler, float4(d, i), l)
#else
#define TETRALIGHT_CONST const
#define TETRALIGHT_MUL(matrix, vector) ((matrix) * (vector))
#define TETRALIGHT_TEXTURE_3D(name) sampler3D name
#define TETRALIGHT_PASS_3D(name) name
#define TETRALIGHT_SAMPLE_3D(name, uvw) textureLod(name, uvw, 0.0f)
#define TETRALIGHT_TEXTURE_ARRAY(name) sampler2DArray name
#define TETRALIGHT_SAMPLE_ARRAY(name, uv, i) textureLod(name, vec3(uv, i), 0.0f)
#define TETRALIGHT_TEXTURE_2D(name) highp sampler2D name
#define TETRALIGHT_SAMPLE_2D(name, uv) textureLod(name, uv, 0.0f)
#define TETRALIGHT_CUBE(name) highp samplerCube name
#define TETRALIGHT_SAMPLE_CUBE(name, d, level) textureLod(name, d, level)
#define TETRALIGHT_CUBES(name) highp samplerCubeArray name
#define TETRALIGHT_PASS_CUBES(name) name
#define TETRALIGHT_SAMPLE_CUBES(name, d, i, level) textureLod(name, vec4(d, i), level)
#ifdef GL_ES
#if __VERSION__ >= 320
#define TETRALIGHT_HAS_CUBE_ARRAYS
#endif
#elif __VERSION__ >= 400
#define TETRALIGHT_HAS_CUBE_ARRAYS
#endif
#ifdef GL_ES
precision highp float;
precision highp int;
precision highp sampler3D;
precision highp sampler2DArray;
#endif
#if (defined(GL_ES) || __VERSION__ < 430) && !defined(TETRALIGHT_TEXTURES)
#define TETRALIGHT_TEXTURES
#endif
#endif
