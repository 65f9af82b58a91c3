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

/// A constant sky: R,G,B, or one number for a grey one. Anything else is the name of a file.
std::optional<glm::dvec3> constant_sky(const std::string& sky) {
    const auto grey = parse_vec3(sky + "," + sky + "," + sky);
    return grey ? grey : parse_vec3(sky);
}

/// A constant sky has radiance ≥ 0; a file that is not there and has commas in its name was meant
/// to be one.
CLI::Validator sky_check() {
    const auto check = [](std::string& sky) -> std::string {
        if (constant_sky(sky)) return numbers_in(0.0, kMaxRadiance)(sky);
        const bool is_file =
            !sky.empty() && (sky.find(',') == std::string::npos || std::filesystem::exists(sky));
        return is_file ? "" : "\"" + sky + "\" is neither R,G,B, nor a number, nor a file";
    };
    return {check, ""};
}

Status check_sky(const Environment& environment) {
    glm::vec3 brightest(environment.image.pixels.empty() ? 1.0f : 0.0f);
    for (const glm::vec3& pixel : environment.image.pixels) brightest = glm::max(brightest, pixel);
    const glm::dvec3 radiance = glm::dvec3(environment.radiance) * glm::dvec3(brightest);
    for (int i = 0; i < 3; ++i) {
        if (radiance[i] >= 0.0 && radiance[i] <= kMaxRadiance) continue;
        return Error{str_cat("the sky's radiance (", radiance.x, ", ", radiance.y, ", ", radiance.z,
                             ") is not in 0 to ", kMaxRadiance)};
    }
    return Ok{};
}

}  // namespace

void SkyOptions::add_to(CLI::App& command, const std::string& replaced) {
    command
        .add_option("--sky", sky,
                    "Radiance of the sky: R,G,B or one number for a constant one, or an "
                    "equirectangular .hdr or .exr file; replaces " +
                        replaced)
        ->check(sky_check())
        ->type_name("R,G,B|L|FILE");
    command.add_option("--sky-intensity", intensity, "Factor on the sky")
        ->check(numbers_in(0.0, kMaxRadiance))
        ->capture_default_str();
    command
        .add_option("--sky-rotation", rotation_degrees,
                    "Degrees to turn the sky about +Y, counter-clockwise from above")
        ->check(numbers_in(-360.0, 360.0))
        ->capture_default_str();
}

Status SkyOptions::apply(const std::string& path, Environment& environment,
                         std::vector<std::string>& warnings) const {
    if (const auto constant = constant_sky(sky)) {
        environment = {};
        environment.radiance = glm::vec3(*constant);
    } else if (!sky.empty()) {
        auto image = read_hdr_image(sky);
        if (!image) return image.error();
        environment = {};
        environment.radiance = glm::vec3(1.0f);
        environment.image = std::move(image->image);
        if (image->mended_pixel_count > 0) {
            warnings.push_back(
                str_cat(sky, ": ", counted(image->mended_pixel_count, "pixel"),
                        " mended (NaN and negative become 0, infinite 65504, and nothing is "
                        "above 1e30)"));
        }
    }
    environment.radiance *= static_cast<float>(intensity);
    environment.rotation_radians += glm::radians(static_cast<float>(rotation_degrees));
    const auto status = check_sky(environment);
    return status ? status : status.error().in(sky.empty() ? path : sky);
}

}  // namespace tetralight::cli
