// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/scene_options.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <tetralight/bake/scene/probe_adjustments_json.h>

namespace tetralight::cli {

SceneOptions::SceneOptions(const Values& values)
    : path(values.text("scene")),
      reading(scene_reading(values)),
      adjustments(has_setting(values, "adjustments") ? values.text("adjustments") : ""),
      sky(values),
      sun_direction(vec3(values, "sun_direction")),
      sun_irradiance(vec3(values, "sun_irradiance")),
      sun_angle_degrees(values.number("sun_angle")),
      sun_mode(values.text("sun_mode") == "baked" ? LightMode::Baked : LightMode::Mixed) {}

Result<Scene> SceneOptions::read(NormalMaps normal_maps) const {
    SceneReading all = reading;
    all.normal_maps = normal_maps;
    auto scene = read_scene(path, all);
    if (!scene) return scene;
    if (auto status = add_adjustments(*scene); !status) return status.error();
    if (auto status = sky.apply(path, scene->environment, scene->warnings); !status) {
        return status.error();
    }
    add_sun(*scene);
    return scene;
}

Status SceneOptions::add_adjustments(Scene& scene) const {
    if (adjustments.empty()) return Ok{};
    auto read = read_probe_adjustments(adjustments);
    if (!read) return read.error();
    auto& all = scene.probe_adjustments;
    all.insert(all.end(), read->begin(), read->end());
    return Ok{};
}

void SceneOptions::add_sun(Scene& scene) const {
    if (sun_direction == glm::dvec3(0.0)) return;
    Light sun;
    sun.mode = sun_mode;
    sun.direction = glm::vec3(glm::normalize(sun_direction));
    sun.intensity = glm::vec3(sun_irradiance);
    sun.radius = glm::radians(0.5f * static_cast<float>(sun_angle_degrees));
    scene.lights.push_back(sun);
    scene.light_names.push_back("command-line sun");
}

}  // namespace tetralight::cli
