// SPDX-License-Identifier: Apache-2.0
// The last file of the shader library: undefines the names that begin.glsl defines for HLSL.
#if defined(TETRALIGHT_HLSL)
#undef vec2
#undef vec3
#undef vec4
#undef uvec4
#undef mat4
#undef mix
#undef inversesqrt
#undef floatBitsToUint
#undef uintBitsToFloat
#endif
#undef TETRALIGHT_CONST
