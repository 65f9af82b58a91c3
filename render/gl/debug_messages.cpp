// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/debug_messages.h>

#include <tetralight/base/str_cat.h>
#include <tetralight/render/gl/gl.h>

namespace tetralight {
namespace {

void APIENTRY take_message(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message,
                           const void* user) {
    const bool is_error = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
                          type == GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR;
    auto& first = *static_cast<std::string*>(const_cast<void*>(user));
    if (is_error && first.empty()) first = message;
}

}  // namespace

DebugMessages::DebugMessages() : first_(std::make_unique<std::string>()) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(take_message, first_.get());
}

Status DebugMessages::check() {
    const GLenum error = glGetError();
    if (first_->empty() && error == GL_NO_ERROR) return Ok{};
    const auto code =
        error == GL_OUT_OF_MEMORY ? ErrorCode::OutOfResources : ErrorCode::Unsupported;
    Error result{code, first_->empty() ? str_cat("OpenGL: error ", error) : "OpenGL: " + *first_};
    first_->clear();
    return result;
}

}  // namespace tetralight
