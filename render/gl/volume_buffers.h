// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <tetralight/runtime/shader_volume.h>

namespace tetralight {

/// A `ShaderVolume` in OpenGL buffers. A context must be current as long as it lives.
class VolumeBuffers {
  public:
    explicit VolumeBuffers(const ShaderVolume& volume);
    VolumeBuffers(VolumeBuffers&& other) noexcept;
    VolumeBuffers& operator=(VolumeBuffers&& other) = delete;
    ~VolumeBuffers();

    /// Binds them where runtime/shaders/query_volume.glsl expects them by default.
    void bind() const;

  private:
    uint32_t constants_ = 0;
    std::array<uint32_t, 5> arrays_{};
};

}  // namespace tetralight
