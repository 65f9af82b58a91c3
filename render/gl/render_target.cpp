// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/render_target.h>

#include <algorithm>

namespace tetralight {
namespace {

GlTexture make_samples(GLenum format, GLsizei samples, GLsizei width, GLsizei height) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &name);
    glTextureStorage2DMultisample(name, samples, format, width, height, GL_TRUE);
    return GlTexture(name);
}

GlTexture make_texture(GLenum format, GLsizei width, GLsizei height) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    glTextureStorage2D(name, 1, format, width, height);
    return GlTexture(name);
}

GlFramebuffer make_frame(const GlTexture& color, const GlTexture* depth) {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, color.name(), 0);
    if (depth) glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth->name(), 0);
    return GlFramebuffer(name);
}

template <class Pixel>
std::vector<Pixel> top_row_first(const std::vector<Pixel>& pixels, size_t width) {
    std::vector<Pixel> flipped;
    flipped.reserve(pixels.size());
    for (auto row = pixels.end(); row != pixels.begin();) {
        row -= static_cast<std::ptrdiff_t>(width);
        flipped.insert(flipped.end(), row, row + static_cast<std::ptrdiff_t>(width));
    }
    return flipped;
}

}  // namespace

RenderTarget::RenderTarget(uint32_t width, uint32_t height, uint32_t sample_count)
    : width_(width), height_(height) {
    const auto w = static_cast<GLsizei>(width), h = static_cast<GLsizei>(height);
    resolved_ = make_texture(GL_RGBA32F, w, h);
    resolved_frame_ = make_frame(resolved_, nullptr);
    if (sample_count > 1) {
        const auto samples = static_cast<GLsizei>(sample_count);
        color_ = make_samples(GL_RGBA32F, samples, w, h);
        depth_ = make_samples(GL_DEPTH_COMPONENT32F, samples, w, h);
    } else {
        color_ = make_texture(GL_RGBA32F, w, h);
        depth_ = make_texture(GL_DEPTH_COMPONENT32F, w, h);
    }
    frame_ = make_frame(color_, &depth_);
}

void RenderTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.name());
    glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
}

void RenderTarget::resolve() const {
    const auto w = static_cast<GLint>(width_), h = static_cast<GLint>(height_);
    glBlitNamedFramebuffer(frame_.name(), resolved_frame_.name(), 0, 0, w, h, 0, 0, w, h,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

ImageF RenderTarget::read() const {
    std::vector<glm::vec3> pixels(size_t{width_} * height_);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(resolved_.name(), 0, GL_RGB, GL_FLOAT,
                      static_cast<GLsizei>(pixels.size() * sizeof(glm::vec3)), pixels.data());
    return {width_, height_, top_row_first(pixels, width_)};
}

std::vector<float> RenderTarget::read_depth() const {
    std::vector<float> depths(size_t{width_} * height_);
    glGetTextureImage(depth_.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                      static_cast<GLsizei>(depths.size() * sizeof(float)), depths.data());
    return top_row_first(depths, width_);
}

}  // namespace tetralight
