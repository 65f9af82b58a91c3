// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/driver.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>
#include <tetralight/render/gl/gl.h>

namespace tetralight {

std::string driver_name() {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name ? name : "";
}

bool is_software(std::string_view driver_name) {
    return driver_name.starts_with("llvmpipe") || driver_name.starts_with("softpipe");
}

uint32_t pixels_per_axis(const RenderSettings& settings) {
    return std::max(1u, settings.samples_per_axis / 2);
}

Status check_size(const RenderSettings& settings, uint32_t pixels_per_axis) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    const uint64_t largest = uint64_t{pixels_per_axis} * std::max(settings.width, settings.height);
    if (largest <= static_cast<uint64_t>(most)) return Ok{};
    const bool is_wide = settings.width >= settings.height;
    return Error{ErrorCode::InvalidArgument, is_wide ? "width" : "height",
                 str_cat(is_wide ? settings.width : settings.height),
                 str_cat("OpenGL: the picture is larger than ", most, " pixels a side: ", largest,
                         pixels_per_axis == 1 ? "" : " including those for antialiasing")};
}

}  // namespace tetralight
