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

/// What draws a scene with balls in it: rays, or OpenGL (render/gl/gl_pictures.h).
struct PictureSource {
    template <class Image>
    using Draw = std::function<Result<Image>(const Camera&, const RenderSettings&,
                                             std::span<const LightBall>)>;

    Draw<ImageF> radiance;
    Draw<DepthImage> depth;
};

/// Draws by rays. Keeps references.
[[nodiscard]] PictureSource ray_traced_pictures(const SceneShader& shader,
                                                const ProbeVolumeView& volume);

/// Draws and develops a picture with gizmos; lines behind a surface are faint.
[[nodiscard]] Result<Image8> render_gizmos(const PictureSource& source,
                                           const ProbeVolumeView& volume, const Camera& camera,
                                           const RenderSettings& settings, const Gizmos& gizmos,
                                           ProbeColor probe_color = ProbeColor::Light);

}  // namespace tetralight
