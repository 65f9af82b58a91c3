// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/render/draw_lines.h>
#include <tetralight/render/gizmos.h>
#include <tetralight/render/image_renderer.h>
#include <tetralight/render/render_scene.h>

namespace tetralight {

/// A renderer of a scene with balls in it: ray tracing, or OpenGL (render/gl/gl_pictures.h).
struct PictureSource {
    template <class Image>
    using Draw = std::function<Result<Image>(const Camera&, const RenderSettings&,
                                             std::span<const LightBall>)>;

    Draw<ImageF> radiance;
    Draw<DepthImage> depth;
    /// False: `radiance` draws sRGB-encoded colours, which need no exposure.
    bool is_light = true;
};

/// Renders by ray tracing. Keeps references to both arguments. Behind views of surfaces there is no
/// sky.
[[nodiscard]] PictureSource ray_traced_pictures(const SceneShader& shader,
                                                const ProbeVolumeView& volume,
                                                SurfaceView view = SurfaceView::Shaded);

/// Renders and develops a picture with gizmos. Lines behind a surface are drawn faintly.
[[nodiscard]] Result<Image8> render_gizmos(const PictureSource& source,
                                           const ProbeVolumeView& volume, const Camera& camera,
                                           const RenderSettings& settings, const Gizmos& gizmos,
                                           ProbeColor probe_color = ProbeColor::Light);

}  // namespace tetralight
