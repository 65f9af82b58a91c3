// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/render/gl/shader_program.h>

namespace tetralight {

/// Bindings of the renderer's shaders, in addition to those of the volume (0 to 4).
enum RendererBinding : uint32_t {
    kFrameBinding = 1,  // uniform blocks
    kProxyBinding = 2,
    kInstanceBinding = 6,  // storage buffers
    kMaterialBinding = 7,
    kLightBinding = 8,
    kLayerBinding = 9,
    kLightmapPlaceBinding = 10,
    kReflectionProbeBinding = 11,
    kBaseColorUnit = 0,  // texture units
    kFactorsUnit = 1,
    kEmissionUnit = 2,
    kShadowUnit = 3,
    kProxyLightUnit = 4,
    kProxyOcclusionUnit = 5,
    kLightmapUnit = 6,
    kNormalUnit = 7,
    kLightmapLightUnit = 8,
    kShadowMaskUnit = 9,
    kAmbientOcclusionUnit = 10,
    kReflectionUnit = 11,
    kSplitSumUnit = 12,
};

/// Locations of uniforms.
enum RendererUniform : int32_t { kClipFromSpace = 0, kFirstInstance = 1 };

struct RendererShaders {
    ShaderProgram depth;         ///< opaque surfaces
    ShaderProgram masked_depth;  ///< surfaces with holes; blended ones in shadow maps
    ShaderProgram lit;
    ShaderProgram sky;
};

/// Returns unsupported with the driver's log if a shader does not compile.
[[nodiscard]] Result<RendererShaders> make_renderer_shaders();

}  // namespace tetralight
