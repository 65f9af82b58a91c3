// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/shader_program.h>

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <utility>

namespace tetralight {
namespace {

std::string shader_log(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(length), '\0');
    glGetShaderInfoLog(shader, length, &length, log.data());
    log.resize(static_cast<size_t>(length));
    return log;
}

std::string program_log(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(length), '\0');
    glGetProgramInfoLog(program, length, &length, log.data());
    log.resize(static_cast<size_t>(length));
    return log;
}

/// Compiles a stage and attaches it to the program, which keeps it.
Status attach(GLuint program, const ShaderStage& stage) {
    const GLuint shader = glCreateShader(stage.stage);
    const char* text = stage.source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint is_compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
    Status status = Ok{};
    if (is_compiled) {
        glAttachShader(program, shader);
    } else {
        status = Error{ErrorCode::Unsupported, name_shader_lines(stage.source, shader_log(shader))};
    }
    glDeleteShader(shader);
    return status;
}

}  // namespace

Result<ShaderProgram> ShaderProgram::create(std::span<const ShaderStage> stages) {
    ShaderProgram program(glCreateProgram());
    for (const ShaderStage& stage : stages) {
        if (auto status = attach(program.name(), stage); !status) return status.error();
    }
    glLinkProgram(program.name());
    GLint is_linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &is_linked);
    if (!is_linked) return Error{ErrorCode::Unsupported, program_log(program.name())};
    return program;
}

ShaderProgram::ShaderProgram(ShaderProgram&& other) noexcept
    : name_(std::exchange(other.name_, 0)) {}

ShaderProgram::~ShaderProgram() {
    if (name_ != 0) glDeleteProgram(name_);
}

}  // namespace tetralight
