// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <tetralight/render/gl/offscreen_context.h>
#include <tetralight/render/gl/renderer.h>
#include <tetralight/render/render_gizmos.h>
#include <tetralight/render/scene_light.h>

namespace tetralight {

/// Renders pictures of a scene by OpenGL without a window.
class GlPictures {
  public:
    /// Returns unsupported if there is no OpenGL 4.5, and the errors of the driver.
    [[nodiscard]] static Result<GlPictures> make(const Scene& scene, const ProbeVolumeView& volume,
                                                 const SceneLight& light);

    /// The same with a given context, which must be current.
    [[nodiscard]] static Result<GlPictures> make(OffscreenContext context, const Scene& scene,
                                                 const ProbeVolumeView& volume,
                                                 const SceneLight& light);

    /// A source that refers to this object.
    [[nodiscard]] PictureSource source();

  private:
    GlPictures(OffscreenContext context, Renderer renderer)
        : context_(std::move(context)), renderer_(std::move(renderer)) {}

    OffscreenContext context_;
    Renderer renderer_;
};

/// Instances of balls that are lit only by their own light.
[[nodiscard]] InstanceBuffer make_light_balls(const Renderer& renderer,
                                              std::span<const LightBall> balls,
                                              uint32_t subdivisions);

}  // namespace tetralight
