// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <type_traits>

#include <tetralight/probes/packed_sh.h>
#include <tetralight/render/gl/gl.h>
#include <tetralight/render/scene_light.h>

namespace tetralight {

/// What lights of the runtime shine on an instance.
enum class DirectUse : uint32_t {
    Still,   ///< all, with the shadows of everything
    Moving,  ///< those that light moving things; static shadows from the probes where they have
             ///< them
    None,
};

/// One instance as shaders read it (std430).
struct GlInstance {
    /// Rows of the affine matrix to the renderer's space.
    glm::vec4 rows[3]{};
    /// Times the material's base colour and alpha.
    glm::vec4 color{1.0f};
    /// x: times the material's metallic; y: times its roughness; z: 1 = it mirrors lights.
    glm::vec4 factors{1.0f, 1.0f, 0.0f, 0.0f};
    ProbeUse use = ProbeUse::Off;
    DirectUse direct = DirectUse::Still;
    /// Index of its material among the renderer's.
    uint32_t material = 0;
    /// 1: its surface is round, and triangles are only near to it.
    uint32_t is_round = 0;
    /// What the static scene lets through of each channel's light.
    glm::vec4 occlusion{1.0f};
    /// With `ProbeUse::Given`.
    PackedSh light{};
};

static_assert(sizeof(GlInstance) == 224 && std::is_trivially_copyable_v<GlInstance>);
static_assert(offsetof(GlInstance, use) == 80 && offsetof(GlInstance, light) == 112);

/// Sets `GlInstance::rows`.
void set_transform(GlInstance& instance, const glm::dmat4& space_from_instance);

/// Instances in memory that OpenGL reads: one batch query writes their light in place
/// (`pack_instances` with `strided`).
class InstanceBuffer {
  public:
    explicit InstanceBuffer(size_t count);

    [[nodiscard]] size_t size() const noexcept { return instances_.size(); }

    /// Waits until what was drawn no longer reads them. They may be written until the next drawing.
    [[nodiscard]] std::span<GlInstance> begin_write();

    /// To be called after drawing with it.
    void end_draw();

    /// Binds a range to a storage buffer binding.
    void bind(GLuint binding, size_t first, size_t count) const;

    /// The most instances that one binding takes. Ranges may begin at its multiples.
    [[nodiscard]] size_t range_size() const noexcept { return range_size_; }

  private:
    GlBuffer buffer_;
    std::span<GlInstance> instances_;
    size_t range_size_ = 0;
    GLsync fence_ = nullptr;
};

}  // namespace tetralight
