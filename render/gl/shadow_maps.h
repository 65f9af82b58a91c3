// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <type_traits>
#include <vector>

#include <tetralight/render/gl/gl.h>
#include <tetralight/render/scene_light.h>

namespace tetralight {

/// A light as shaders read it (std430).
struct GlLight {
    glm::vec4 position{0.0f};   ///< w: range
    glm::vec4 direction{0.0f};  ///< w: `LightType`
    glm::vec4 intensity{0.0f};  ///< w: `LightFalloff`
    glm::vec4 shape{0.0f};      ///< cosines of the inner and the outer cone, area
    /// x: first layer with the shadows of all objects; y: first layer with those of moving objects;
    /// z: layers of each (0 = no shadows); w: occlusion channel of the probes (-1 = none).
    glm::ivec4 shadow{0, 0, 0, -1};
    /// x: 1 if it lights moving objects; y: `LightmapShadow`.
    glm::ivec4 reach{1, 0, 0, 0};
};

static_assert(sizeof(GlLight) == 96 && std::is_trivially_copyable_v<GlLight>);

/// Which objects a layer shows.
enum class ShadowCasters : uint8_t { All, Moving };

/// A layer of the shadow maps as shaders read it (std430).
struct GlShadowLayer {
    glm::mat4 clip_from_space{1.0f};
    /// x: size of a texel in render space; y: 1 = at depth 1.
    glm::vec4 texel{0.0f};
};

/// Depth maps of lights: one layer for a directional light, six for others. If probes store the
/// occlusion of a light, it has a second set of layers with moving objects only.
class ShadowMaps {
  public:
    /// `bounds`: center and radius of all casters in render space. Lights may be outside.
    /// `lightmaps`: of the static surfaces; may have no pages.
    ShadowMaps(std::span<const RuntimeLight> lights, const LightmapsView& lightmaps,
               glm::vec4 bounds, uint32_t size);

    /// Draws every layer: `draw(clip_from_space, casters)`.
    void draw(const std::function<void(const glm::mat4&, ShadowCasters)>& draw) const;

    /// Binds the lights, the layers and the maps.
    void bind(GLuint light_binding, GLuint layer_binding, GLuint unit) const;

    [[nodiscard]] uint32_t light_count() const noexcept { return light_count_; }

  private:
    struct Layer {
        glm::mat4 clip_from_space{1.0f};
        ShadowCasters casters = ShadowCasters::All;
    };

    std::vector<Layer> layers_;
    uint32_t light_count_ = 0;
    uint32_t size_ = 0;
    GlBuffer lights_, gl_layers_;
    GlTexture maps_;
    GlFramebuffer frame_;
};

}  // namespace tetralight
