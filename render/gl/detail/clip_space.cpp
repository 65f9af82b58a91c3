// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/detail/clip_space.h>

namespace tetralight::detail {

ClipSpace::ClipSpace(const Camera& camera, double aspect, double near, double far)
    : aspect_(aspect) {
    // One of both is 0: w is 1 or the depth.
    const PictureHeight height = picture_height(camera);
    half_height_ = 0.5 * (height.at_eye + height.per_metre);
    w_ = {0.5 * height.at_eye / half_height_, 0.5 * height.per_metre / half_height_};
    z_ = w_.at(near);
    z_per_metre_ = z_ / far;
}

glm::dmat4 ClipSpace::clip_from_view() const {
    glm::dmat4 clip(0.0);
    clip[0][0] = 1.0 / (half_height_ * aspect_);
    clip[1][1] = 1.0 / half_height_;
    clip[2][2] = z_per_metre_;
    clip[3][2] = z_;
    clip[2][3] = -w_.per_metre;
    clip[3][3] = w_.at_eye;
    return clip;
}

double ClipSpace::depth(double value) const {
    // value = (z_ - z_per_metre_ * depth) / w_.at(depth)
    return (z_ - value * w_.at_eye) / (z_per_metre_ + value * w_.per_metre);
}

}  // namespace tetralight::detail
