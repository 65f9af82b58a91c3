// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <tetralight/bake/image/image.h>

namespace tetralight {

/// Writes ASCII text into a picture, white on a dark rim, 14 pixels high; `x` and `y` are the upper
/// left corner. What lies outside of the picture is left out.
void draw_text(Image8& image, float x, float y, std::string_view text);

}  // namespace tetralight
