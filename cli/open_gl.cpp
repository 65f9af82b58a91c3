// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/open_gl.h>

#include <utility>

#include <tetralight/render/gl/driver.h>

namespace tetralight::cli {

std::optional<OffscreenContext> open_gl(const RenderSettings& settings,
                                        const CommonOptions& common) {
    auto context = OffscreenContext::create();
    const Status status =
        context ? check_size(settings, pixels_per_axis(settings)) : Status(context.error());
    if (!status) {
        common.warn("", status.error(), "; rendering on the CPU");
        return std::nullopt;
    }
    const std::string driver = driver_name();
    if (is_software(driver)) {
        common.warn({"OpenGL runs in software, " + driver + ": --renderer cpu may be faster here"});
    }
    return std::move(*context);
}

}  // namespace tetralight::cli
