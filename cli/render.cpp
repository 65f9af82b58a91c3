// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <utility>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/choice.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/gizmo_options.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/renderer_options.h>
#include <tetralight/cli/validators.h>
#include <tetralight/cli/view_options.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/render/render_gizmos.h>
#ifdef TETRALIGHT_HAS_GL
#include <tetralight/base/error_text.h>
#include <tetralight/cli/open_gl.h>
#include <tetralight/render/gl/gl_pictures.h>
#endif

namespace tetralight::cli {
namespace {

struct Render {
    std::string scene_path;
    std::string volume_path;
    std::string output;
    GizmoOptions gizmos;
    ProbeLight probes = ProbeLight::AsTheScene;
    RendererKind renderer = RendererKind::Cpu;
    ViewOptions view;
    CommonOptions common;

    void add_to(CLI::App& command) {
        add_path(command, "SCENE", scene_path, "glTF 2.0 scene")->required();
        add_path(command, "VOLUME", volume_path, "Probe volume baked from it (.probes)")
            ->required();
        add_output(command, output, ".png", "Picture to write");
        gizmos.add_to(command);
        add_renderer(command, renderer);
        add_choice(command, "--probes", probes,
                   {{"scene", ProbeLight::AsTheScene},
                    {"one", ProbeLight::OnePlace},
                    {"still", ProbeLight::StillOnly},
                    {"none", ProbeLight::Nothing}},
                   "Who takes light from the probes: all, as the scene asks; all, and things that "
                   "move from one place each; what stands still alone; nothing");
        view.add_to(command);
        view.add_camera_name(command);
        common.add_to(command);
    }

    /// By OpenGL where it was asked for and is there, else by rays.
    [[nodiscard]] Result<Image8> draw(const Scene& scene, const ProbeVolumeView& volume,
                                      const Camera& camera) const {
        auto light = make_scene_light(scene, volume, probes);
        if (!light) return light.error().in(scene_path);
        const Gizmos shown = make_gizmos(volume, light->proxy_volumes, gizmos.settings);
        const auto render = [&](const PictureSource& source) {
            return render_gizmos(source, volume, camera, view.settings, shown,
                                 gizmos.settings.probe_color);
        };
        if (renderer == RendererKind::Gl) {
#ifdef TETRALIGHT_HAS_GL
            if (auto context = open_gl(view.settings, common)) {
                auto pictures = GlPictures::make(std::move(*context), scene, volume, *light);
                if (pictures) return render(pictures->source());
                common.warn({error_text(pictures.error()) + "; rendering on the CPU"});
            }
#else
            common.warn({"this build has no OpenGL; rendering on the CPU"});
#endif
        }
        const auto shader = SceneShader::make(scene, volume, std::move(*light));
        if (!shader) return shader.error();
        return render(ray_traced_pictures(*shader, volume));
    }

    Status run() {
        if (auto status = check_output(output, {scene_path, volume_path}); !status) return status;
        const auto scene = read_gltf(scene_path);
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        common.warn_if_unlit(volume_path, file->view());
        const auto chosen = view.camera_in(*scene, scene_path);
        if (!chosen) return chosen.error();

        view.settings.thread_count = common.thread_count;
        const auto start = std::chrono::steady_clock::now();
        const auto image = draw(*scene, file->view(), *chosen);
        if (!image) return image.error();
        auto status = write_png(output, *image);
        if (!status) return status;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        common.report(output, {{"output", output}, {"seconds", elapsed.count()}},
                      str_cat(output, ": ", image->width, "×", image->height, " in ",
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
