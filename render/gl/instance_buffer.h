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

/// Which direct lights an instance takes.
enum class DirectUse : uint32_t {
    Still,   ///< all lights, with the shadows of all objects
    Moving,  ///< lights that light moving objects; static shadows from the probes if they have them
    None,    ///< none
};

/// One instance as shaders read it (std430).
struct GlInstance {
    /// Rows of the affine matrix to the renderer's space.
    glm::vec4 rows[3]{};
    /// Multiplies the material's base colour and alpha.
    glm::vec4 color{1.0f};
    /// x multiplies the material's metallic, y its roughness; z: 1 = it has highlights; w: 1 = it
    /// mirrors reflection probes.
    glm::vec4 factors{1.0f, 1.0f, 0.0f, 0.0f};
    ProbeUse use = ProbeUse::Off;
    DirectUse direct = DirectUse::Still;
    /// Index of its material in the renderer.
    uint32_t material = 0;
    /// 1 = the surface is a sphere that the triangles approximate.
    uint32_t is_round = 0;
    /// For each occlusion channel: the fraction of its light that the static scene lets through.
    glm::vec4 occlusion{1.0f};
    /// For `ProbeUse::Given`.
    PackedSh light{};
};

static_assert(sizeof(GlInstance) == 224 && std::is_trivially_copyable_v<GlInstance>);
static_assert(offsetof(GlInstance, use) == 80 && offsetof(GlInstance, light) == 112);

/// Sets `GlInstance::rows`.
void set_transform(GlInstance& instance, const glm::dmat4& space_from_instance);

/// Instances in a persistently mapped buffer: one batch query writes their light in place
/// (`pack_instances` with `strided`).
class InstanceBuffer {
  public:
    explicit InstanceBuffer(size_t count);

    [[nodiscard]] size_t size() const noexcept { return instances_.size(); }

    /// Waits until the GPU no longer reads the instances. They may be written until the next draw.
    [[nodiscard]] std::span<GlInstance> begin_write();

    /// Call after each draw that reads the buffer.
    void end_draw();

    /// Binds a range to a storage buffer binding.
    void bind(GLuint binding, size_t first, size_t count) const;

    /// The largest number of instances in one binding. Ranges may begin at its multiples.
    [[nodiscard]] size_t range_size() const noexcept { return range_size_; }

  private:
    GlBuffer buffer_;
    std::span<GlInstance> instances_;
    size_t range_size_ = 0;
    GLsync fence_ = nullptr;
};

}  // namespace tetralight
