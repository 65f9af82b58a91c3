// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/volume_buffers.h>

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <span>
#include <utility>

namespace tetralight {
namespace {

uint32_t make_buffer(std::span<const std::byte> bytes) {
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), 0);
    return buffer;
}

template <class Element>
uint32_t make_buffer(const std::vector<Element>& elements) {
    return make_buffer(std::as_bytes(std::span(elements)));
}

}  // namespace

VolumeBuffers::VolumeBuffers(const ShaderVolume& volume)
    : constants_(make_buffer(std::as_bytes(std::span(&volume.constants, 1)))),
      arrays_{make_buffer(volume.positions), make_buffer(volume.light), make_buffer(volume.cells),
              make_buffer(volume.hull_rays), make_buffer(volume.seeds), make_buffer(volume.walls)} {
}

VolumeBuffers::VolumeBuffers(VolumeBuffers&& other) noexcept
    : constants_(std::exchange(other.constants_, 0)), arrays_(std::exchange(other.arrays_, {})) {}

VolumeBuffers::~VolumeBuffers() {
    glDeleteBuffers(1, &constants_);  // 0 is silently ignored
    glDeleteBuffers(static_cast<GLsizei>(arrays_.size()), arrays_.data());
}

void VolumeBuffers::bind() const {
    glBindBufferBase(GL_UNIFORM_BUFFER, 6, constants_);
    for (size_t i = 0; i < arrays_.size(); ++i) {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(i), arrays_[i]);
    }
}

}  // namespace tetralight
