// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>

namespace tetralight {

/// An OpenGL 4.5 core context without a window, current on the thread that made it: EGL on Mesa's
/// surfaceless platform, else on EGL's default display. Software rendering (llvmpipe) is enough.
class OffscreenContext {
  public:
    /// Errors say which step failed and EGL's number for it.
    [[nodiscard]] static Result<OffscreenContext> create();

    OffscreenContext(OffscreenContext&& other) noexcept;
    OffscreenContext& operator=(OffscreenContext&& other) = delete;
    ~OffscreenContext();

  private:
    OffscreenContext(void* display, void* context) : display_(display), context_(context) {}

    void* display_;
    void* context_;
};

}  // namespace tetralight
