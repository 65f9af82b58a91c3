// SPDX-License-Identifier: Apache-2.0
#include "cli/scene_options.h"

#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include "bake/image/read_image.h"
#include "bake/scene/read_gltf.h"
#include "base/text.h"
#include "cli/common.h"
#include "cli/paths.h"

namespace tetralight::cli {

namespace {

/// Sums over directions and bounces stay far from the largest float, 3e38.
constexpr double kMaxRadiance = 1e30;

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

CLI::Validator direction_check() {
    const auto check = [](const std::string& direction) -> std::string {
        const auto parsed = parse_vec3(direction);
        if (!parsed || glm::length(*parsed) > 0.0) return "";
        return "\"" + direction + "\" is not a direction";
    };
    return {check, ""};
}

Status check_sky(const Environment& environment) {
    glm::vec3 brightest(environment.image.pixels.empty() ? 1.0f : 0.0f);
    for (const glm::vec3& pixel : environment.image.pixels) brightest = glm::max(brightest, pixel);
    const glm::dvec3 radiance = glm::dvec3(environment.radiance) * glm::dvec3(brightest);
    for (int i = 0; i < 3; ++i) {
        if (radiance[i] >= 0.0 && radiance[i] <= kMaxRadiance) continue;
        return Error{text("the sky's radiance (", radiance.x, ", ", radiance.y, ", ", radiance.z,
                          ") is not in 0 to ", kMaxRadiance)};
    }
    return Ok{};
}

}  // namespace

void SceneOptions::add_to(CLI::App& command) {
    add_path(command, "SCENE", path, "glTF 2.0 scene (.glb or .gltf)")->required();
    command
        .add_option("--sky", sky,
                    "Radiance of the sky: R,G,B or one number for a constant one, or an "
                    "equirectangular .hdr or .exr file; replaces the scene's own")
        ->check(sky_check())
        ->type_name("R,G,B|L|FILE");
    command.add_option("--sky-intensity", sky_intensity, "Factor on the sky")
        ->check(numbers_in(0.0, kMaxRadiance))
        ->capture_default_str();
    command
        .add_option("--sky-rotation", sky_rotation_degrees,
                    "Degrees to turn the sky about +Y, counter-clockwise from above")
        ->check(numbers_in(-360.0, 360.0))
        ->capture_default_str();
    auto* direction = add_vec3(command, "--sun-direction", sun_direction,
                               "Add a sun that shines in this direction");
    auto* irradiance = add_vec3(command, "--sun-irradiance", sun_irradiance,
                                "Irradiance of the added sun on a surface that faces it");
    direction->check(direction_check())->needs(irradiance);
    irradiance->check(numbers_in(0.0, kMaxRadiance).description(""))->type_name("R,G,B");
    irradiance->needs(direction);
    command
        .add_option(
            "--sun-angle", sun_angle_degrees,
            "Diameter of the added sun in the sky, degrees: soft shadows (the sun's is 0.53)")
        ->check(numbers_in(0.0, 180.0))
        ->needs(direction)
        ->capture_default_str();
    command
        .add_option("--sun-mode", sun_mode,
                    "What probes hold of the added sun: its bounces (mixed), or its direct "
                    "light too (baked)")
        ->check(CLI::IsMember({"mixed", "baked"}))
        ->needs(direction)
        ->capture_default_str();
}

Result<Scene> SceneOptions::read() const {
    auto scene = read_gltf(path);
    if (!scene) return scene;
    if (auto status = add_sky(*scene); !status) return status.error();
    add_sun(*scene);
    return scene;
}

Status SceneOptions::add_sky(Scene& scene) const {
    Environment& environment = scene.environment;
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
            scene.warnings.push_back(text(sky, ": ", counted(image->mended_pixel_count, "pixel"),
                                          " mended (NaN and negative become 0, infinite 65504, "
                                          "and nothing is above 1e30)"));
        }
    }
    environment.radiance *= static_cast<float>(sky_intensity);
    environment.rotation_radians += glm::radians(static_cast<float>(sky_rotation_degrees));
    const auto status = check_sky(environment);
    return status ? status : status.error().in(sky.empty() ? path : sky);
}

void SceneOptions::add_sun(Scene& scene) const {
    if (sun_direction == glm::dvec3(0.0)) return;
    Light sun;
    sun.mode = sun_mode == "baked" ? LightMode::Baked : LightMode::Mixed;
    sun.direction = glm::vec3(glm::normalize(sun_direction));
    sun.intensity = glm::vec3(sun_irradiance);
    sun.radius = glm::radians(0.5f * static_cast<float>(sun_angle_degrees));
    scene.lights.push_back(sun);
    scene.light_names.push_back("command-line sun");
}

}  // namespace tetralight::cli
