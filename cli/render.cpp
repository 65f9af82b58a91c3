// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <utility>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/lightmap_files.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/renderer_kind.h>
#include <tetralight/cli/scene_reading.h>
#include <tetralight/cli/show_settings.h>
#include <tetralight/cli/view_options.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/reflection/reflection_file.h>
#include <tetralight/render/opening_lines.h>
#include <tetralight/render/render_gizmos.h>
#include <tetralight/render/seam_lines.h>
#include <tetralight/render/with_walls.h>
#ifdef TETRALIGHT_HAS_GL
#include <tetralight/cli/open_gl.h>
#include <tetralight/render/gl/gl_pictures.h>
#endif

namespace tetralight::cli {
namespace {

bool is_empty(const GizmoLines& group) {
    return group.lines.empty();
}

struct Render {
    std::string scene_path;
    SceneReading reading;
    std::string volume_path;
    std::string lightmap_path;
    std::string reflection_path;
    std::string output;
    ShowSettings shown;
    bool has_ambient_occlusion = false;
    bool has_box_projection = true;
    std::optional<glm::vec3> shadow_color;
    ProbeLight probes = ProbeLight::AsTheScene;
    LightmapLight lightmap_light = LightmapLight::Directional;
    Walls walls = Walls::HideProbes;
    RendererKind renderer = RendererKind::Cpu;
    ViewOptions view;
    CommonOptions common;

    explicit Render(const Values& values)
        : scene_path(values.text("scene")),
          reading(scene_reading(values, NormalMaps::Read)),
          volume_path(values.text("volume")),
          lightmap_path(values.text("lightmaps")),
          reflection_path(values.text("reflections")),
          output(values.text("output")),
          shown(show_settings(values)),
          has_ambient_occlusion(values.flag("ambient_occlusion")),
          has_box_projection(!values.flag("no_box_projection")),
          probes(choice<ProbeLight>(values, "probes")),
          lightmap_light(choice<LightmapLight>(values, "lightmap_light")),
          walls(choice<Walls>(values, "walls")),
          renderer(choice<RendererKind>(values, "renderer")),
          view(values),
          common(values) {
        if (values.is_given("shadow_color")) shadow_color = glm::vec3(vec3(values, "shadow_color"));
    }

    /// By OpenGL if it was asked for and is available, else by rays.
    [[nodiscard]] Result<Image8> draw(const Scene& scene, const ProbeVolumeView& volume,
                                      const LightmapsView& lightmaps,
                                      const ReflectionsView& reflections,
                                      const Camera& camera) const {
        auto light = make_scene_light(scene, volume, probes, lightmaps);
        if (!light) return in_light_files(light.error(), {scene_path, volume_path, lightmap_path});
        light->has_ambient_occlusion = has_ambient_occlusion;
        if (shadow_color) light->shadow_color = *shadow_color;
        if (shadow_color && lightmaps.info.mixed_lighting != MixedLighting::Subtractive) {
            common.warn({str_cat("the shadow color changes nothing: ", shown_path(lightmap_path),
                                 " is not subtractive")});
        }
        light->lightmap_light = lightmap_light;
        light->reflections = reflections;
        light->has_box_projection = has_box_projection;
        Gizmos gizmos = make_gizmos(volume, light->proxy_volumes, shown.gizmos);
        if (shown.gizmos.has_seams)
            std::ranges::move(make_seam_lines(scene, lightmaps), std::back_inserter(gizmos.lines));
        if (shown.gizmos.has_openings) {
            auto openings = make_opening_lines(scene);
            if (!openings) return openings.error().in(scene_path);
            if (std::ranges::all_of(*openings, &is_empty)) {
                common.warn({"no opening was found through which light enters a dark place"});
            }
            std::ranges::move(*openings, std::back_inserter(gizmos.lines));
        }
        const auto render = [&](const PictureSource& source) {
            return render_gizmos(source, volume, camera, view.settings, gizmos,
                                 shown.gizmos.probe_color);
        };
        if (renderer == RendererKind::Gl && shown.view != SurfaceView::Shaded) {
            common.warn({"OpenGL draws no views of surfaces; rendering on the CPU"});
        } else if (renderer == RendererKind::Gl) {
#ifdef TETRALIGHT_HAS_GL
            if (auto context = open_gl(view.settings, common)) {
                auto pictures = GlPictures::make(std::move(*context), scene, volume, *light);
                if (pictures) return render(pictures->source());
                common.warn("", pictures.error(), "; rendering on the CPU");
            }
#else
            common.warn({"this build has no OpenGL; rendering on the CPU"});
#endif
        }
        const auto shader = SceneShader::make(scene, volume, std::move(*light));
        if (!shader) return shader.error();
        return render(ray_traced_pictures(*shader, volume, shown.view));
    }

    /// What the picture needs of the lightmaps.
    [[nodiscard]] Status check_sections(const LightmapsView& lightmaps) const {
        const auto missing = [&](const char* what, const char* option) {
            return Error{
                ErrorCode::InvalidArgument, "lightmaps", lightmap_path,
                str_cat(shown_path(lightmap_path), ": has no ", what, "; bake it with ", option)};
        };
        const bool shows_occlusion =
            has_ambient_occlusion || shown.view == SurfaceView::AmbientOcclusion;
        if (shows_occlusion && lightmaps.ambient_occlusion.empty())
            return missing("ambient occlusion", "--ambient-occlusion");
        if (shown.view == SurfaceView::ShadowMask && lightmaps.shadow_mask.empty())
            return missing("shadow mask", "--mixed-lighting shadowmask");
        return Ok{};
    }

    [[nodiscard]] Result<std::optional<ReflectionFile>> open_reflections() const {
        if (reflection_path.empty()) return std::optional<ReflectionFile>();
        auto file = open_reflection_file(reflection_path);
        if (!file) return file.error();
        return std::optional(std::move(*file));
    }

    Status run() {
        const std::vector<std::string> inputs{scene_path, volume_path, lightmap_path,
                                              reflection_path};
        if (auto status = check_output(output, inputs); !status) return status;
        const auto scene = read_scene(scene_path, reading);
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        common.warn_if_unlit(volume_path, file->view());
        const auto chosen = view.camera_in(*scene, scene_path);
        if (!chosen) return chosen.error();

        const auto start = std::chrono::steady_clock::now();
        const auto lightmaps = open_lightmaps(lightmap_path);
        if (!lightmaps) return lightmaps.error();
        if (*lightmaps) {
            if (auto status = check_sections((*lightmaps)->view()); !status) return status;
        }
        const auto reflections = open_reflections();
        if (!reflections) return reflections.error();
        const auto image = draw(*scene, with_walls(file->view(), walls),
                                *lightmaps ? (*lightmaps)->view() : LightmapsView{},
                                *reflections ? (*reflections)->view() : ReflectionsView{}, *chosen);
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

Status run_render(const Values& values) {
    return Render(values).run();
}

}  // namespace tetralight::cli
