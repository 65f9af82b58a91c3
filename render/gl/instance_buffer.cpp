// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/instance_buffer.h>

#include <algorithm>
#include <glm/matrix.hpp>

namespace tetralight {
namespace {

/// Ranges hold a multiple of this many instances, so that their offsets are multiples of 256, the
/// strictest alignment that OpenGL allows drivers to require.
constexpr size_t kStep = 8;
static_assert(kStep * sizeof(GlInstance) % 256 == 0);

}  // namespace

void set_transform(GlInstance& instance, const glm::dmat4& space_from_instance) {
    const glm::dmat4 rows = glm::transpose(space_from_instance);
    for (int i = 0; i < 3; ++i) instance.rows[i] = glm::vec4(rows[i]);
}

InstanceBuffer::InstanceBuffer(size_t count) : buffer_(make_gl_buffer()) {
    const auto bytes = static_cast<GLsizeiptr>(std::max<size_t>(count, 1) * sizeof(GlInstance));
    const GLbitfield access =
        GL_MAP_WRITE_BIT | GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    glNamedBufferStorage(buffer_.name(), bytes, nullptr, access);
    void* memory = glMapNamedBufferRange(buffer_.name(), 0, bytes, access);
    if (memory != nullptr) instances_ = {static_cast<GlInstance*>(memory), count};
    std::ranges::fill(instances_, GlInstance{});
    GLint64 largest = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
    range_size_ = static_cast<size_t>(largest) / sizeof(GlInstance) / kStep * kStep;
}

std::span<GlInstance> InstanceBuffer::begin_write() {
    if (fence_ != nullptr) {
        constexpr GLuint64 kOneSecond = 1'000'000'000;
        glClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, kOneSecond);
        glDeleteSync(fence_);
        fence_ = nullptr;
    }
    return instances_;
}

void InstanceBuffer::end_draw() {
    if (fence_ != nullptr) glDeleteSync(fence_);
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void InstanceBuffer::bind(GLuint binding, size_t first, size_t count) const {
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer_.name(),
                      static_cast<GLintptr>(first * sizeof(GlInstance)),
                      static_cast<GLsizeiptr>(count * sizeof(GlInstance)));
}

}  // namespace tetralight
