// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/sky_options.h>

#include <filesystem>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {
namespace {

Status check_sky(const Environment& environment) {
    glm::vec3 brightest(environment.image.pixels.empty() ? 1.0f : 0.0f);
    for (const glm::vec3& pixel : environment.image.pixels) brightest = glm::max(brightest, pixel);
    const glm::dvec3 radiance = glm::dvec3(environment.radiance) * glm::dvec3(brightest);
    for (int i = 0; i < 3; ++i) {
        if (radiance[i] >= 0.0 && radiance[i] <= kMaxRadiance) continue;
        return Error{ErrorCode::InvalidArgument, "sky", "",
                     str_cat("the sky's radiance (", radiance.x, ", ", radiance.y, ", ", radiance.z,
                             ") is not in the range 0 to 1e30")};
    }
    return Ok{};
}

}  // namespace

SkyOptions::SkyOptions(const Values& values)
    : intensity(values.number("sky_intensity")), rotation_degrees(values.number("sky_rotation")) {
    const auto* sky = values.find("sky");
    if (sky == nullptr) return;
    if (sky->is_number()) {
        constant = glm::dvec3(sky->get<double>());
    } else if (sky->is_array()) {
        constant = vec3(values, "sky");
    } else {
        path = sky->get<std::string>();
    }
}

Status SkyOptions::apply(const std::string& scene_path, Environment& environment,
                         std::vector<std::string>& warnings) const {
    if (constant) {
        environment = {};
        environment.radiance = glm::vec3(*constant);
    } else if (!path.empty()) {
        auto image = read_hdr_image(path);
        if (!image) return image.error();
        environment = {};
        environment.radiance = glm::vec3(1.0f);
        environment.image = std::move(image->image);
        if (image->mended_pixel_count > 0) {
            warnings.push_back(
                str_cat(path, ": ", counted(image->mended_pixel_count, "pixel"),
                        " repaired (NaN and negative become 0, infinite 65504, and nothing is "
                        "above 1e30)"));
        }
    }
    environment.radiance *= static_cast<float>(intensity);
    environment.rotation_radians += glm::radians(static_cast<float>(rotation_degrees));
    const auto status = check_sky(environment);
    return status ? status : status.error().in(path.empty() ? scene_path : path);
}

}  // namespace tetralight::cli
