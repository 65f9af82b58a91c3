// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <tetralight/cli/common.h>
#include <tetralight/render/gl/offscreen_context.h>
#include <tetralight/render/image_renderer.h>

namespace tetralight::cli {

/// OpenGL for pictures of such a size. None where it is not there or too small for them: a warning
/// says why, and that the CPU renders. Warns of drivers that draw on the CPU, too.
[[nodiscard]] std::optional<OffscreenContext> open_gl(const RenderSettings& settings,
                                                      const CommonOptions& common);

}  // namespace tetralight::cli
