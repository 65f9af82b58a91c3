// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <tetralight/cli/common.h>
#include <tetralight/render/gl/offscreen_context.h>
#include <tetralight/render/image_renderer.h>

namespace tetralight::cli {

/// OpenGL for pictures of such a size. None if it is missing or too small for them: a warning
/// gives the reason, and the CPU renders. Also warns of drivers that draw on the CPU.
[[nodiscard]] std::optional<OffscreenContext> open_gl(const RenderSettings& settings,
                                                      const CommonOptions& common);

}  // namespace tetralight::cli
