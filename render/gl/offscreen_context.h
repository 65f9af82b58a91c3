// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>

namespace tetralight {

/// An OpenGL 4.5 core context without a window, current on the thread that created it. It uses EGL
/// on Mesa's surfaceless platform if available, else on EGL's default display. Software rendering
/// (llvmpipe) is enough.
class OffscreenContext {
  public:
    /// Returns unsupported with the step that failed and EGL's error number.
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
