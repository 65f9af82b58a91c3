// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/bake/image/image.h>
#include <tetralight/render/gl/gl.h>

namespace tetralight {

/// A framebuffer with float radiance, depth, and samples that `resolve` averages.
class RenderTarget {
  public:
    RenderTarget(uint32_t width, uint32_t height, uint32_t sample_count);

    [[nodiscard]] uint32_t width() const noexcept { return width_; }

    [[nodiscard]] uint32_t height() const noexcept { return height_; }

    /// Makes it the target of draw calls.
    void bind() const;

    /// Averages the samples into `radiance`.
    void resolve() const;

    /// The resolved picture as a texture, bottom row first.
    [[nodiscard]] GLuint radiance() const noexcept { return resolved_.name(); }

    /// The resolved picture.
    [[nodiscard]] ImageF read() const;

    /// The depth buffer, top row first. Precondition: one sample a pixel.
    [[nodiscard]] std::vector<float> read_depth() const;

  private:
    uint32_t width_;
    uint32_t height_;
    GlTexture color_, depth_, resolved_;
    GlFramebuffer frame_, resolved_frame_;
};

}  // namespace tetralight
