// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/render/gl/gl.h>

namespace tetralight {

/// The pages of lightmaps as one array texture, and where each instance lies in them.
class LightmapTextures {
  public:
    LightmapTextures() = default;

    /// `instances`: for each instance that is drawn, its index in `lightmaps.rectangles`; others
    /// have no place.
    LightmapTextures(const LightmapsView& lightmaps, std::span<const uint32_t> instances);

    void bind(GLuint places_binding, GLuint pages_unit) const;

  private:
    GlTexture pages_;
    GlBuffer places_;
};

}  // namespace tetralight
