// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include <tetralight/base/result.h>
#include <tetralight/reflection/reflections.h>
#include <tetralight/render/gl/gl.h>

namespace tetralight {

/// Reflection probes as an array of cubes, the split-sum table as a texture, and the places of the
/// probes in the order in which they cover each other.
class ReflectionTextures {
  public:
    /// None.
    ReflectionTextures() = default;

    /// `origin`: world position of the origin of render space. Returns unsupported if OpenGL holds
    /// fewer cubes, or smaller ones.
    [[nodiscard]] static Result<ReflectionTextures> make(const ReflectionsView& reflections,
                                                         const glm::dvec3& origin);

    /// To the bindings of `RendererBinding`.
    void bind() const;

    [[nodiscard]] uint32_t probe_count() const noexcept { return probe_count_; }

    [[nodiscard]] uint32_t level_count() const noexcept { return level_count_; }

  private:
    GlTexture cubes_;
    GlTexture split_sum_;
    GlBuffer probes_;
    uint32_t probe_count_ = 0;
    uint32_t level_count_ = 0;
};

}  // namespace tetralight
