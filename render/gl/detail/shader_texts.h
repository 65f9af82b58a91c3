// SPDX-License-Identifier: Apache-2.0
#pragma once

// GLSL of the renderer. renderer_shaders.cpp joins these texts with parts of the shader library.

namespace tetralight::detail {

/// Structs and bindings of instances and materials, and `image_uv`.
extern const char* const kInstanceText;
/// Vertex stage of surfaces.
extern const char* const kSurfaceVertexText;
/// What the vertex stage of surfaces hands to fragment stages.
extern const char* const kSurfaceInputText;
/// Depth of opaque surfaces.
extern const char* const kDepthText;
/// Depth of surfaces with holes, and of blended ones in shadow maps.
extern const char* const kMaskedDepthText;
/// The uniform block of a frame.
extern const char* const kFrameText;
/// What surfaces mirror of reflection probes.
extern const char* const kReflectionText;
/// Shading of surfaces.
extern const char* const kLitText;
/// A triangle that covers the picture.
extern const char* const kSkyVertexText;
/// Radiance of the sky.
extern const char* const kSkyText;

}  // namespace tetralight::detail
