// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tetralight/base/error_text.h>
#include <tetralight/render/gl/offscreen_context.h>
#include <tetralight/render/gl/shader_program.h>
#include <tetralight/render/gl/volume_buffers.h>

namespace tetralight::test {

/// What a shader computes from `inputs`: `vec4 result(uint index, uint part)`, for each index and
/// each part. It reads with `vec4 input_at(uint i)`.
struct ShaderTask {
    std::string result;
    std::span<const glm::vec4> inputs;
    uint32_t index_count = 0;
    uint32_t part_count = 1;
    /// Binds what else the shader reads.
    std::function<void(const ShaderProgram&)> bind = {};
};

/// A texture of `kShaderTextureWidth` texels a row that holds 16-byte elements.
class ElementTexture {
  public:
    ElementTexture(std::span<const std::byte> elements, GLenum format, GLenum layout, GLenum type) {
        const size_t count = elements.size() / 16;
        const size_t height = (count + kShaderTextureWidth - 1) / kShaderTextureWidth;
        std::vector<std::byte> texels(16 * kShaderTextureWidth * height);
        std::copy(elements.begin(), elements.end(), texels.begin());
        const auto width = static_cast<GLsizei>(kShaderTextureWidth);
        const auto rows = static_cast<GLsizei>(height);
        glCreateTextures(GL_TEXTURE_2D, 1, &name_);
        glTextureStorage2D(name_, 1, format, width, rows);
        glTextureSubImage2D(name_, 0, 0, 0, width, rows, layout, type, texels.data());
        glTextureParameteri(name_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(name_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }

    ElementTexture(const ElementTexture&) = delete;
    ElementTexture& operator=(const ElementTexture&) = delete;

    ~ElementTexture() { glDeleteTextures(1, &name_); }

    void bind(const ShaderProgram& program, const char* uniform, GLuint unit) const {
        glBindTextureUnit(unit, name_);
        const GLint location = glGetUniformLocation(program.name(), uniform);
        glProgramUniform1i(program.name(), location, static_cast<GLint>(unit));
    }

    template <class Element>
    static ElementTexture of_floats(std::span<const Element> elements) {
        return {std::as_bytes(elements), GL_RGBA32F, GL_RGBA, GL_FLOAT};
    }

    template <class Element>
    static ElementTexture of_integers(std::span<const Element> elements) {
        return {std::as_bytes(elements), GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT};
    }

  private:
    GLuint name_ = 0;
};

/// Runs shader tasks on OpenGL 4.5, in GLSL 4.50 as compute shaders with storage buffers, and in
/// GLSL ES 3.00 as fragment shaders with textures.
class ShaderRunner : public testing::Test {
  protected:
    void SetUp() override {
        auto created = OffscreenContext::create();
        if (!created) {
            GTEST_SKIP() << error_text(created.error())
                         << ": install Mesa (libegl1, libgl1-mesa-dri) to run this test";
        }
        context.emplace(std::move(*created));
    }

    std::vector<glm::vec4> run_compute(const ShaderTask& task, ShaderPart part,
                                       const ShaderVolume* volume = nullptr) {
        const std::string body = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 8) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 9) writeonly buffer Results { vec4 results[]; };
vec4 input_at(uint i) { return inputs[i]; }
)" + task.result + R"(
void main() {
    uint thread = gl_GlobalInvocationID.x;
    if (thread < uint(results.length())) results[thread] = result(thread / PARTS, thread % PARTS);
}
)";
        const ShaderSource source =
            compose_shader(ShaderLanguage::Glsl450, {part}, {"task.comp", with_parts(body, task)});
        const ShaderStage stage{GL_COMPUTE_SHADER, source};
        const auto program = ShaderProgram::create(std::span(&stage, 1));
        if (!program) {
            ADD_FAILURE() << error_text(program.error());
            return {};
        }
        std::optional<VolumeBuffers> buffers;
        if (volume) buffers.emplace(*volume).bind();
        return dispatch(*program, task);
    }

    std::vector<glm::vec4> run_fragment(const ShaderTask& task, ShaderPart part,
                                        const ShaderVolume* volume = nullptr) {
        const ShaderSource vertices =
            compose_shader(ShaderLanguage::GlslEs300, {}, {"task.vert", R"(
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)"});
        const std::string body = R"(
uniform highp sampler2D inputs;
out highp vec4 color;
vec4 input_at(uint i) { return texelFetch(inputs, ivec2(int(i & 2047u), int(i >> 11u)), 0); }
)" + task.result + R"(
void main() {
    uint thread = uint(gl_FragCoord.x) + 2048u * uint(gl_FragCoord.y);
    color = result(thread / PARTS, thread % PARTS);
}
)";
        const ShaderSource fragments = compose_shader(ShaderLanguage::GlslEs300, {part},
                                                      {"task.frag", with_parts(body, task)});
        const std::array stages{ShaderStage{GL_VERTEX_SHADER, vertices},
                                ShaderStage{GL_FRAGMENT_SHADER, fragments}};
        const auto program = ShaderProgram::create(stages);
        if (!program) {
            ADD_FAILURE() << error_text(program.error());
            return {};
        }
        return draw(*program, task, volume);
    }

    std::optional<OffscreenContext> context;

  private:
    static std::string with_parts(const std::string& body, const ShaderTask& task) {
        return "#define PARTS " + std::to_string(task.part_count) + "u\n" + body;
    }

    static std::vector<glm::vec4> dispatch(const ShaderProgram& program, const ShaderTask& task) {
        const size_t thread_count = size_t{task.index_count} * task.part_count;
        std::vector<glm::vec4> results(thread_count);
        std::array<GLuint, 2> buffers{};
        glCreateBuffers(2, buffers.data());
        glNamedBufferStorage(buffers[0], static_cast<GLsizeiptr>(task.inputs.size_bytes()),
                             task.inputs.data(), 0);
        const auto size = static_cast<GLsizeiptr>(16 * thread_count);
        glNamedBufferStorage(buffers[1], size, nullptr, 0);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 8, buffers[0]);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 9, buffers[1]);
        glUseProgram(program.name());
        if (task.bind) task.bind(program);
        glDispatchCompute(static_cast<GLuint>((thread_count + 63) / 64), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glGetNamedBufferSubData(buffers[1], 0, size, results.data());
        glDeleteBuffers(2, buffers.data());
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
        return results;
    }

    static std::vector<glm::vec4> draw(const ShaderProgram& program, const ShaderTask& task,
                                       const ShaderVolume* volume) {
        const auto inputs = ElementTexture::of_floats(task.inputs);
        inputs.bind(program, "inputs", 7);
        if (!volume) return draw_pixels(program, task);
        const auto positions = ElementTexture::of_floats(std::span(volume->positions));
        const auto light = ElementTexture::of_floats(std::span(volume->light));
        const auto cells = ElementTexture::of_integers(std::span(volume->cells));
        const auto hull_rays = ElementTexture::of_floats(std::span(volume->hull_rays));
        const auto seeds = ElementTexture::of_integers(std::span(volume->seeds));
        const auto walls = ElementTexture::of_integers(std::span(volume->walls));
        positions.bind(program, "tetralight_positions", 0);
        light.bind(program, "tetralight_light", 1);
        cells.bind(program, "tetralight_cells", 2);
        hull_rays.bind(program, "tetralight_hull_rays", 3);
        seeds.bind(program, "tetralight_seeds", 4);
        walls.bind(program, "tetralight_walls", 5);
        GLuint constants = 0;
        glCreateBuffers(1, &constants);
        glNamedBufferStorage(constants, sizeof volume->constants, &volume->constants, 0);
        glUniformBlockBinding(program.name(),
                              glGetUniformBlockIndex(program.name(), "TetralightVolume"), 0);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, constants);
        auto results = draw_pixels(program, task);
        glDeleteBuffers(1, &constants);
        return results;
    }

    static std::vector<glm::vec4> draw_pixels(const ShaderProgram& program,
                                              const ShaderTask& task) {
        const size_t thread_count = size_t{task.index_count} * task.part_count;
        const auto width = static_cast<GLsizei>(kShaderTextureWidth);
        const auto height =
            static_cast<GLsizei>((thread_count + kShaderTextureWidth - 1) / kShaderTextureWidth);
        GLuint target = 0, frame = 0, vertices = 0;
        glCreateTextures(GL_TEXTURE_2D, 1, &target);
        glTextureStorage2D(target, 1, GL_RGBA32F, width, height);
        glCreateFramebuffers(1, &frame);
        glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT0, target, 0);
        glCreateVertexArrays(1, &vertices);
        glBindVertexArray(vertices);
        glBindFramebuffer(GL_FRAMEBUFFER, frame);
        glViewport(0, 0, width, height);
        glUseProgram(program.name());
        if (task.bind) task.bind(program);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        std::vector<glm::vec4> results(kShaderTextureWidth * static_cast<size_t>(height));
        glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, results.data());
        results.resize(thread_count);
        glDeleteVertexArrays(1, &vertices);
        glDeleteFramebuffers(1, &frame);
        glDeleteTextures(1, &target);
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
        return results;
    }
};

}  // namespace tetralight::test
