// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/lppv/lppv.h>
#include <tetralight/render/gl/gl.h>

namespace tetralight {

/// A proxy volume as two 3D textures in full precision: seven slabs of light, and occlusion.
class ProxyTextures {
  public:
    /// `origin`: world position of the origin of render space.
    ProxyTextures(const Lppv& lppv, const glm::dvec3& origin);

    void bind(GLuint constants_binding, GLuint light_unit, GLuint occlusion_unit) const;

  private:
    GlTexture light_, occlusion_;
    GlBuffer constants_;
};

}  // namespace tetralight
