// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include "bake/image/write_image.h"
#include "bake/scene/read_gltf.h"
#include "base/text.h"
#include "cli/choice.h"
#include "cli/common.h"
#include "cli/paths.h"
#include "cli/view_options.h"
#include "pipeline/render_cells.h"
#include "probes/probe_file.h"

namespace tetralight::cli {
namespace {

struct Render {
    std::string scene_path;
    std::string volume_path;
    std::string output;
    std::string camera_name;
    CellOverlay overlay;
    ViewOptions view;
    CommonOptions common;

    void add_to(CLI::App& command) {
        add_path(command, "SCENE", scene_path, "glTF 2.0 scene")->required();
        add_path(command, "VOLUME", volume_path, "Probe volume baked from it (.probes)")
            ->required();
        add_output(command, output, ".png", "Picture to write");
        auto* camera_option =
            command.add_option("--camera", camera_name,
                               "Camera of the scene by name; without it and --eye the scene's "
                               "first, else an overview");
        command.add_flag("--wireframe", overlay.has_edges,
                         "Draw the edges of the cells over the scene; those of the hull in orange");
        command
            .add_option("--probe-radius", overlay.probe_radius,
                        "Show the probes as white balls of this radius, lit by what they hold")
            ->check(numbers_in(1e-6, 1e9));
        add_choice(
            command, "--probe-color", overlay.probe_color,
            {{"light", ProbeColor::Light},
             {"validity", ProbeColor::Validity},
             {"error", ProbeColor::Error}},
            "What the balls show instead: validity = share of directions without back faces, "
            "error = relative standard error; teal is good, yellow fair, red bad")
            ->needs("--probe-radius");
        command
            .add_option("--lppv-radius", overlay.proxy_radius,
                        "Show the points of the objects' proxy volumes as balls of this radius")
            ->check(numbers_in(1e-6, 1e9));
        add_choice(command, "--movers", overlay.movers,
                   {{"scene", MoverLight::AsTheScene}, {"probe", MoverLight::OnePlace}},
                   "Light of things that move: as the scene asks, with proxy volumes, or from one "
                   "place for each");
        view.add_to(command);
        camera_option->excludes(view.eye_option);
        common.add_to(command);
    }

    [[nodiscard]] Result<Camera> camera(const Scene& scene) const {
        if (view.has_camera) return view.camera();
        for (const Camera& candidate : scene.cameras) {
            if (!camera_name.empty() && candidate.name != camera_name) continue;
            return candidate;
        }
        if (camera_name.empty()) return overview(scene);
        std::string names;
        for (const Camera& candidate : scene.cameras) names += " \"" + candidate.name + "\"";
        return Error{scene_path + ": no camera \"" + camera_name +
                     "\"; there is:" + (names.empty() ? " none" : names)};
    }

    Status run() {
        if (auto status = check_output(output, {scene_path, volume_path}); !status) return status;
        const auto scene = read_gltf(scene_path);
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        common.warn_if_unlit(volume_path, file->view());
        const auto chosen = camera(*scene);
        if (!chosen) return chosen.error();

        view.settings.thread_count = common.thread_count;
        const auto start = std::chrono::steady_clock::now();
        const auto image = render_cells(*scene, file->view(), *chosen, view.settings, overlay);
        if (!image) return image.error();
        auto status = write_png(output, *image);
        if (!status) return status;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        common.report(output, {{"output", output}, {"seconds", elapsed.count()}},
                      text(output, ": ", image->width, "×", image->height, " in ",
                           duration(elapsed.count())));
        return Ok{};
    }
};

}  // namespace

void add_render(CLI::App& app, Run& run) {
    add_command<Render>(app, run, "render", "Render a scene with the light of a probe volume",
                        "tetralight render courtyard.glb courtyard.probes -o courtyard.png");
}

}  // namespace tetralight::cli
