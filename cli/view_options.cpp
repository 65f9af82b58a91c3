// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/view_options.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/validators.h>

namespace tetralight::cli {

void ViewOptions::add_to(CLI::App& command) {
    const CLI::Range side(1u, 16384u);
    command.add_option("--width", settings.width, "Pixels")->check(side)->capture_default_str();
    command.add_option("--height", settings.height, "Pixels")->check(side)->capture_default_str();
    command
        .add_option("--antialias", settings.samples_per_axis, "Camera rays a pixel along each axis")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    command
        .add_option("--exposure", settings.exposure,
                    "Factor before tone mapping (Khronos PBR Neutral); 0 = automatic")
        ->check(numbers_in(0.0, 1e9))
        ->capture_default_str();
    auto* eye_option = add_vec3(command, "--eye", eye, "Camera position");
    auto* target_option = add_vec3(command, "--target", target, "What the camera looks at");
    eye_option->needs(target_option)->each([this](const std::string&) { has_camera = true; });
    target_option->needs(eye_option);
    command.add_option("--fov", fov_degrees, "Vertical field of view of --eye, degrees")
        ->check(numbers_in(1.0, 170.0))
        ->needs(eye_option)
        ->capture_default_str();
    command.parse_complete_callback([this] { check_usage(); });
}

void ViewOptions::check_usage() const {
    if (has_camera && eye == target) {
        throw CLI::ValidationError("--target", "is the same point as --eye");
    }
}

void ViewOptions::add_camera_name(CLI::App& command) {
    command
        .add_option("--camera", camera_name,
                    "Camera of the scene by name; without it and --eye the scene's first, else an "
                    "overview")
        ->check(not_empty("name"))
        ->excludes(command.get_option("--eye"));
}

Result<Camera> ViewOptions::camera_in(const Scene& scene, const std::string& scene_path) const {
    if (has_camera) return camera();
    for (const Camera& candidate : scene.cameras) {
        if (camera_name.empty() || candidate.name == camera_name) return candidate;
    }
    if (camera_name.empty()) return overview(scene);
    std::string names;
    for (const Camera& candidate : scene.cameras) names += " \"" + candidate.name + "\"";
    return Error{scene_path + ": no camera \"" + camera_name +
                 "\"; there is:" + (names.empty() ? " none" : names)};
}

Camera ViewOptions::camera() const {
    return look_at(eye, target, glm::radians(fov_degrees));
}

Camera overview(const Scene& scene) {
    const WorldBox bounds =
        scene_bounds(scene, [](const MeshInstance&) { return true; }).value_or(WorldBox{});
    const double fov = glm::radians(45.0);
    const double distance = 0.75 * std::max(glm::length(bounds.size()), 1e-3) / std::tan(fov / 2);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.5, 0.45, 1.0));
    return look_at(bounds.center() + direction * distance, bounds.center(), fov);
}

}  // namespace tetralight::cli
