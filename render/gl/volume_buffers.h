// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <tetralight/runtime/shader_volume.h>

namespace tetralight {

/// A `ShaderVolume` in OpenGL buffers. A context must be current during its lifetime.
class VolumeBuffers {
  public:
    explicit VolumeBuffers(const ShaderVolume& volume);
    VolumeBuffers(VolumeBuffers&& other) noexcept;
    VolumeBuffers& operator=(VolumeBuffers&& other) = delete;
    ~VolumeBuffers();

    /// Binds the buffers at the default bindings of runtime/shaders/query_volume.glsl.
    void bind() const;

  private:
    uint32_t constants_ = 0;
    std::array<uint32_t, 6> arrays_{};
};

}  // namespace tetralight
