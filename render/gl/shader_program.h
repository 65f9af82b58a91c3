// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/runtime/shader_library.h>

namespace tetralight {

/// One stage of a program: GL_VERTEX_SHADER, GL_FRAGMENT_SHADER or GL_COMPUTE_SHADER.
struct ShaderStage {
    uint32_t stage = 0;
    const ShaderSource& source;
};

/// A linked OpenGL program. A context must be current during its lifetime.
class ShaderProgram {
  public:
    /// Returns unsupported with the driver's log, in which each line number follows the name of its
    /// file.
    [[nodiscard]] static Result<ShaderProgram> create(std::span<const ShaderStage> stages);

    ShaderProgram(ShaderProgram&& other) noexcept;
    ShaderProgram& operator=(ShaderProgram&& other) = delete;
    ~ShaderProgram();

    /// OpenGL's name of the program.
    [[nodiscard]] uint32_t name() const noexcept { return name_; }

  private:
    explicit ShaderProgram(uint32_t name) : name_(name) {}

    uint32_t name_;
};

}  // namespace tetralight
