// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include <tetralight/render/gl/gl.h>
#include <tetralight/render/scene_light.h>

namespace tetralight {

/// The pages of lightmaps as array textures, and where each instance lies in them.
class LightmapTextures {
  public:
    LightmapTextures() = default;

    /// `instances`: for each instance that is drawn, its index in the rectangles of the lightmaps;
    /// others have no place. Copies section `light` for `Directional` if there are normal maps.
    LightmapTextures(const SceneLight& light, bool has_normal_maps,
                     std::span<const uint32_t> instances);

    /// To the bindings of `RendererBinding`.
    void bind() const;

  private:
    GlTexture pages_;
    GlTexture directions_;
    GlTexture shadow_mask_;        ///< white if there is none
    GlTexture ambient_occlusion_;  ///< white if it darkens nothing
    GlBuffer places_;
};

}  // namespace tetralight
