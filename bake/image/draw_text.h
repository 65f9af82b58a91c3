// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/bake/image/image.h>

namespace tetralight {

/// Draws ASCII text into an image, white with a dark outline, 14 pixels high. `x` and `y` are the
/// upper left corner. Text outside of the image is clipped.
void draw_text(Image8& image, float x, float y, std::string_view text);

}  // namespace tetralight
