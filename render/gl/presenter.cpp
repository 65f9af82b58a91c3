// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/presenter.h>

#include <array>
#include <utility>

namespace tetralight {
namespace {

constexpr const char* kVertex = R"(
out vec2 place;
void main() {
    place = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
)";

// The same functions as in runtime/tone_map.cpp and bake/image/srgb.cpp.
constexpr const char* kFragment = R"(
layout(binding = 0) uniform sampler2D radiance;
layout(location = 0) uniform float exposure;
in vec2 place;
out vec4 shown;

vec3 tone_map_neutral(vec3 color) {
    const float start = 0.8 - 0.04;
    const float desaturation = 0.15;
    float lowest = min(color.r, min(color.g, color.b));
    float offset = lowest < 0.08 ? lowest - 6.25 * lowest * lowest : 0.04;
    color -= offset;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < start) return color;
    float room = 1.0 - start;
    float new_peak = 1.0 - room * room / (peak + room - start);
    color *= new_peak / peak;
    float white = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    return mix(color, vec3(new_peak), white);
}

float srgb(float linear) {
    linear = clamp(linear, 0.0, 1.0);
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

void main() {
    vec3 color = tone_map_neutral(texture(radiance, place).rgb * exposure);
    shown = vec4(srgb(color.r), srgb(color.g), srgb(color.b), 1.0);
}
)";

GlVertexArray make_arrays() {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return GlVertexArray(name);
}

}  // namespace

Presenter::Presenter(ShaderProgram program)
    : program_(std::move(program)), arrays_(make_arrays()) {}

Result<Presenter> Presenter::make() {
    const ShaderSource vertex =
        compose_shader(ShaderLanguage::Glsl450, {}, {"present.vert", kVertex});
    const ShaderSource fragment =
        compose_shader(ShaderLanguage::Glsl450, {}, {"present.frag", kFragment});
    const std::array stages{ShaderStage{GL_VERTEX_SHADER, vertex},
                            ShaderStage{GL_FRAGMENT_SHADER, fragment}};
    auto program = ShaderProgram::create(stages);
    if (!program) return program.error();
    return Presenter(std::move(*program));
}

void Presenter::present(const RenderTarget& target, GLuint frame, uint32_t width, uint32_t height,
                        float exposure) const {
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glUseProgram(program_.name());
    glProgramUniform1f(program_.name(), 0, exposure);
    glBindTextureUnit(0, target.radiance());
    glBindVertexArray(arrays_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace tetralight
