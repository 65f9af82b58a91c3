// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>

#include <tetralight/render/image_renderer.h>

namespace tetralight::detail {

/// Clip space of a camera. Depth values fall from 1 at the near plane to 0 at the far plane, where
/// floats are densest.
class ClipSpace {
  public:
    /// `aspect`: width of the picture / height. `near`: for perspective cameras; orthographic ones
    /// see from the plane through them. `far`: may be infinite for perspective cameras.
    ClipSpace(const Camera& camera, double aspect, double near, double far);

    /// View space: right, up and back from the eye.
    [[nodiscard]] glm::dmat4 clip_from_view() const;

    /// Depth along the view of a depth value.
    [[nodiscard]] double depth(double value) const;

  private:
    double aspect_;
    /// Half the picture's height where `w` is 1.
    double half_height_;
    /// `w`: the picture's height, scaled to 1 at the eye or at depth 1.
    PictureHeight w_;
    /// `z` at the eye, and what it falls by per metre of depth.
    double z_, z_per_metre_;
};

}  // namespace tetralight::detail
