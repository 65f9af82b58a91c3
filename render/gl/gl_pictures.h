// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <tetralight/render/gl/offscreen_context.h>
#include <tetralight/render/gl/renderer.h>
#include <tetralight/render/render_gizmos.h>
#include <tetralight/render/scene_light.h>

namespace tetralight {

/// Pictures of a scene by OpenGL without a window.
class GlPictures {
  public:
    /// Errors: there is no OpenGL 4.5, and the driver's.
    [[nodiscard]] static Result<GlPictures> make(const Scene& scene, const ProbeVolumeView& volume,
                                                 const SceneLight& light);

    /// The same by a context that is current.
    [[nodiscard]] static Result<GlPictures> make(OffscreenContext context, const Scene& scene,
                                                 const ProbeVolumeView& volume,
                                                 const SceneLight& light);

    /// Of them; refers to this.
    [[nodiscard]] PictureSource source();

  private:
    GlPictures(OffscreenContext context, Renderer renderer)
        : context_(std::move(context)), renderer_(std::move(renderer)) {}

    OffscreenContext context_;
    Renderer renderer_;
};

/// Balls as a crowd that shows its light and nothing else.
[[nodiscard]] InstanceBuffer make_light_balls(const Renderer& renderer,
                                              std::span<const LightBall> balls,
                                              uint32_t subdivisions);

}  // namespace tetralight
