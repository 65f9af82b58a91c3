// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/base/result.h>
#include <tetralight/render/gl/gl.h>
#include <tetralight/render/gl/render_target.h>
#include <tetralight/render/gl/shader_program.h>

namespace tetralight {

/// Copies a target into a framebuffer of 8 bits a channel as `develop` does: exposed, tone-mapped
/// (Khronos PBR Neutral) and sRGB-encoded. A context must be current during its lifetime.
class Presenter {
  public:
    /// Returns unsupported with the driver's log if a shader does not compile.
    [[nodiscard]] static Result<Presenter> make();

    /// Fills `width` × `height` pixels of a framebuffer (0: the window's) with the resolved
    /// picture.
    void present(const RenderTarget& target, GLuint frame, uint32_t width, uint32_t height,
                 float exposure) const;

  private:
    explicit Presenter(ShaderProgram program);

    ShaderProgram program_;
    GlVertexArray arrays_;
};

}  // namespace tetralight
