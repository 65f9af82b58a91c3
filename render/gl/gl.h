// SPDX-License-Identifier: Apache-2.0
#pragma once

// Functions and constants of OpenGL, and owners of its objects.

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <utility>

namespace tetralight {

/// Sole owner of an OpenGL object, which `Delete(name)` deletes. A context must be current during
/// its lifetime.
template <auto Delete>
class GlObject {
  public:
    GlObject() = default;

    explicit GlObject(GLuint name) : name_(name) {}

    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}

    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }

    ~GlObject() {
        if (name_ != 0) Delete(name_);
    }

    /// OpenGL's name of the object; 0 if there is none.
    [[nodiscard]] GLuint name() const noexcept { return name_; }

  private:
    GLuint name_ = 0;
};

namespace detail {

inline void delete_buffer(GLuint name) {
    glDeleteBuffers(1, &name);
}

inline void delete_texture(GLuint name) {
    glDeleteTextures(1, &name);
}

inline void delete_framebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}

inline void delete_vertex_array(GLuint name) {
    glDeleteVertexArrays(1, &name);
}

}  // namespace detail

using GlBuffer = GlObject<detail::delete_buffer>;
using GlTexture = GlObject<detail::delete_texture>;
using GlFramebuffer = GlObject<detail::delete_framebuffer>;
using GlVertexArray = GlObject<detail::delete_vertex_array>;

[[nodiscard]] inline GLuint make_gl_buffer() {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    return name;
}

/// An immutable buffer with a copy of `elements`. If `elements` is empty it holds one default
/// element, because OpenGL has no empty buffers.
template <class Container>
[[nodiscard]] GlBuffer make_gl_buffer(const Container& elements) {
    using Element = typename Container::value_type;
    static const Element kNone{};
    GlBuffer buffer(make_gl_buffer());
    const bool is_empty = elements.empty();
    glNamedBufferStorage(
        buffer.name(), static_cast<GLsizeiptr>((is_empty ? 1 : elements.size()) * sizeof(Element)),
        is_empty ? &kNone : elements.data(), 0);
    return buffer;
}

}  // namespace tetralight
