// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/scene_options.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <tetralight/bake/scene/probe_adjustments_json.h>
#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/paths.h>

namespace tetralight::cli {

namespace {

CLI::Validator direction_check() {
    const auto check = [](const std::string& direction) -> std::string {
        const auto parsed = parse_vec3(direction);
        if (!parsed || glm::length(*parsed) > 0.0) return "";
        return "\"" + direction + "\" is not a direction";
    };
    return {check, ""};
}

}  // namespace

void SceneOptions::add_to(CLI::App& command) {
    add_path(command, "SCENE", path, "glTF 2.0 scene (.glb or .gltf)")->required();
    add_path(
        command, "--adjustments", adjustments,
        "Adjustment volumes beside the scene's own (.json): where probes are forbidden, denser, "
        "valid, or scaled");
    sky.add_to(command, "the scene's own");
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
    if (!scene && read_probe_groups(path)) return Error{path + ": holds probe groups, no scene"};
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
    sun.mode = sun_mode == "baked" ? LightMode::Baked : LightMode::Mixed;
    sun.direction = glm::vec3(glm::normalize(sun_direction));
    sun.intensity = glm::vec3(sun_irradiance);
    sun.radius = glm::radians(0.5f * static_cast<float>(sun_angle_degrees));
    scene.lights.push_back(sun);
    scene.light_names.push_back("command-line sun");
}

}  // namespace tetralight::cli
