// SPDX-License-Identifier: Apache-2.0
#include "cli/view_options.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "base/text.h"
#include "cli/common.h"

namespace tetralight::cli {

void ViewOptions::add_to(CLI::App& command) {
    command.add_option("--width", settings.width, "Pixels")->capture_default_str();
    command.add_option("--height", settings.height, "Pixels")->capture_default_str();
    command
        .add_option("--antialias", settings.samples_per_axis, "Camera rays a pixel along each axis")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    command
        .add_option("--exposure", settings.exposure,
                    "Factor before tone mapping (Khronos PBR Neutral); 0 = automatic")
        ->capture_default_str();
    auto* eye_option = add_vec3(command, "--eye", eye, "Camera position");
    auto* target_option = add_vec3(command, "--target", target, "What the camera looks at");
    eye_option->needs(target_option)->each([this](const std::string&) { has_camera = true; });
    target_option->needs(eye_option);
    command.add_option("--fov", fov_degrees, "Vertical field of view of --eye, degrees")
        ->check(CLI::Range(1.0, 170.0))
        ->capture_default_str();
}

Result<Camera> ViewOptions::camera() const {
    if (!(glm::distance(eye, target) > 0.0)) {
        return Error{
            text("--eye and --target are the same point (", eye.x, ", ", eye.y, ", ", eye.z, ")")};
    }
    return look_at(eye, target, glm::radians(fov_degrees));
}

Status ViewOptions::check() const {
    for (const uint32_t side : {settings.width, settings.height}) {
        if (side == 0 || side > 16384) {
            return Error{text("a picture side of ", side, " pixels is not in 1..16384")};
        }
    }
    return Ok{};
}

}  // namespace tetralight::cli
