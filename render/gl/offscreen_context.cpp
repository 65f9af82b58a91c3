// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/offscreen_context.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string_view>
#include <utility>

#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

Error egl_error(const char* what) {
    return {ErrorCode::Unsupported,
            str_cat("OpenGL: ", what, " failed (EGL error ", eglGetError(), ")")};
}

EGLDisplay find_display() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const bool is_surfaceless =
        extensions && std::string_view(extensions).find("EGL_MESA_platform_surfaceless") !=
                          std::string_view::npos;
    if (is_surfaceless) {
        return eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    }
    return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

}  // namespace

Result<OffscreenContext> OffscreenContext::create() {
    const EGLDisplay display = find_display();
    if (display == EGL_NO_DISPLAY) return egl_error("finding a display");
    if (!eglInitialize(display, nullptr, nullptr)) return egl_error("eglInitialize");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 EGL_TRUE,
                                 EGL_NONE};
    EGLContext context = EGL_NO_CONTEXT;
    if (eglBindAPI(EGL_OPENGL_API)) {
        context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    }
    if (context == EGL_NO_CONTEXT) return egl_error("creating an OpenGL 4.5 context");
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        eglDestroyContext(display, context);
        return egl_error("eglMakeCurrent");
    }
    return OffscreenContext(display, context);
}

OffscreenContext::OffscreenContext(OffscreenContext&& other) noexcept
    : display_(std::exchange(other.display_, nullptr)),
      context_(std::exchange(other.context_, nullptr)) {}

OffscreenContext::~OffscreenContext() {
    if (!context_) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
}

}  // namespace tetralight
