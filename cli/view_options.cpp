// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/view_options.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight::cli {

ViewOptions::ViewOptions(const Values& values)
    : eye(vec3(values, "eye")),
      target(vec3(values, "target")),
      fov_degrees(values.number("fov")),
      has_camera(values.is_given("eye")) {
    settings.width = values.integer32("width");
    settings.height = values.integer32("height");
    settings.samples_per_axis = values.integer32("antialias");
    settings.exposure = values.number32("exposure");
    settings.thread_count = values.integer32("threads");
    if (values.table().find("camera") != nullptr) camera_name = values.text("camera");
    if (has_camera && eye == target) {
        refuse(values, "target", "is the same point as " + values.shown("eye"));
    }
}

Result<Camera> ViewOptions::camera_in(const Scene& scene, const std::string& scene_path) const {
    if (has_camera) return camera();
    for (const Camera& candidate : scene.cameras) {
        if (camera_name.empty() || candidate.name == camera_name) return candidate;
    }
    if (camera_name.empty()) return overview(scene);
    std::string names;
    for (const Camera& candidate : scene.cameras) names += " \"" + candidate.name + "\"";
    return Error{ErrorCode::NotFound, "camera", camera_name,
                 scene_path + ": no camera \"" + camera_name +
                     "\"; the scene has:" + (names.empty() ? " none" : names)};
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
