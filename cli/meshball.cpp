// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/ball_options.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/lightmap_files.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/renderer_kind.h>
#include <tetralight/cli/scene_reading.h>
#include <tetralight/cli/view_options.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/reflection/reflection_file.h>
#include <tetralight/render/mesh_ball.h>
#include <tetralight/render/with_walls.h>
#ifdef TETRALIGHT_HAS_GL
#include <tetralight/cli/ball_window.h>
#include <tetralight/cli/open_gl.h>
#include <tetralight/render/gl/gl_mesh_ball.h>
#endif

namespace tetralight::cli {
namespace {

/// "ball.png", 7 → "ball_0007.png"
std::string frame_path(const std::filesystem::path& path, uint32_t frame) {
    char number[16];
    std::snprintf(number, sizeof number, "_%04u", frame);
    const std::string name = path.stem().string() + number + path.extension().string();
    return (path.parent_path() / name).string();
}

bool is_stream(const std::string& path) {
    std::error_code error;
    return path == "-" || std::filesystem::is_character_file(path, error);
}

struct MeshBall {
    /// Draws the ball, turned by some angle.
    using Draw = std::function<Result<MeshBallPicture>(double angle)>;

    std::string volume_path;
    std::string scene_path;
    SceneReading reading;
    std::string lightmap_path;
    std::string reflection_path;
    std::string output;
    uint32_t frame_count = 1;
    bool has_frames = false;
    bool has_window = false;
    BallOptions ball;
    Walls walls = Walls::HideProbes;
    RendererKind renderer = RendererKind::Cpu;
    ViewOptions view;
    CommonOptions common;

    explicit MeshBall(const Values& values)
        : volume_path(values.text("volume")),
          scene_path(values.text("scene")),
          reading(scene_reading(values, NormalMaps::Read)),
          lightmap_path(values.text("lightmaps")),
          reflection_path(values.text("reflections")),
          output(values.text("output")),
          frame_count(values.integer32("frames")),
          has_frames(values.is_given("frames")),
          has_window(values.flag("window")),
          ball(values),
          walls(choice<Walls>(values, "walls")),
          renderer(choice<RendererKind>(values, "renderer")),
          view(values),
          common(values) {
        if (output.empty() && !has_window) require(values, "output");
        if (!lightmap_path.empty() && scene_path.empty()) require(values, "scene");
        if (frame_count > 1 && !has_window && is_stream(output)) {
            refuse(values, "frames",
                   "several pictures need a file name, which \"" + output + "\" is not");
        }
    }

    [[nodiscard]] std::string picture_path(uint32_t frame) const {
        return frame_count == 1 ? output : frame_path(output, frame);
    }

    Status run() {
        if (!has_window) {
            const std::vector<std::string> inputs{volume_path, scene_path, lightmap_path,
                                                  reflection_path};
            auto status = check_output(picture_path(0), inputs);
            if (!status) return status;
        }
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        common.warn_if_unlit(volume_path, file->view());
        const ProbeVolumeView volume = with_walls(file->view(), walls);
        Scene scene;
        if (!scene_path.empty()) {
            auto read = read_scene(scene_path, reading);
            if (!read) return read.error();
            common.warn(read->warnings);
            scene = std::move(*read);
        }
        const auto lightmaps = open_lightmaps(lightmap_path);
        if (!lightmaps) return lightmaps.error();
        auto light = make_scene_light(scene, volume, ProbeLight::AsTheScene,
                                      *lightmaps ? (*lightmaps)->view() : LightmapsView{});
        if (!light) return in_light_files(light.error(), {scene_path, volume_path, lightmap_path});
        std::optional<ReflectionFile> reflections;
        if (!reflection_path.empty()) {
            auto opened = open_reflection_file(reflection_path);
            if (!opened) return opened.error();
            reflections = std::move(*opened);
            light->reflections = reflections->view();
        }
        std::optional<SceneShader> shader;
        if (!scene_path.empty()) {
            auto made = SceneShader::make(scene, volume, *light);
            if (!made) return made.error().in(scene_path);
            shader.emplace(std::move(*made));
        }
        return render(volume, scene, std::move(*light), shader ? &*shader : nullptr);
    }

    Status render(const ProbeVolumeView& volume, const Scene& scene, SceneLight light,
                  const SceneShader* shader) {
        const Camera camera = ball.place(volume, shader, view);
        if (has_window) return show(volume, scene, std::move(light), camera);
        if (renderer == RendererKind::Gl) {
#ifdef TETRALIGHT_HAS_GL
            const auto context = open_gl(view.settings, common);
            if (context) return render_gl(volume, scene, std::move(light), camera);
#else
            common.warn({"this build has no OpenGL; rendering on the CPU"});
#endif
        }
        const Mirror mirror(light.reflections, light.has_box_projection);
        return render_cpu(volume, shader, mirror, camera);
    }

    Status show(const ProbeVolumeView& volume, const Scene& scene, SceneLight light,
                const Camera& camera) const {
#ifdef TETRALIGHT_HAS_GL
        const auto shown = show_ball(ball, scene, std::move(light), volume, camera, view.settings,
                                     has_frames ? frame_count : 0);
        if (!shown) return shown.error();
        common.print(
            {{"frames", shown->frame_count}, {"seconds", shown->seconds}},
            str_cat(counted(shown->frame_count, "frame"), " in ", duration(shown->seconds)));
        return Ok{};
#else
        static_cast<void>(volume), static_cast<void>(scene), static_cast<void>(light),
            static_cast<void>(camera);
        return Error{ErrorCode::Unsupported, "window", "true",
                     "this build has no OpenGL, and so no window"};
#endif
    }

    Status render_cpu(const ProbeVolumeView& volume, const SceneShader* shader,
                      const Mirror& mirror, const Camera& camera) {
        const auto proxy = make_ball_proxy(ball.settings, volume);
        if (!proxy) return proxy.error();
        const BallLighting lighting{ball.light, ball.specular, &*proxy, &mirror};
        const std::vector<BallInstance> still = make_mesh_ball(ball.settings);
        return write_frames(camera, [&](double angle) {
            const BallTurn turn(ball.settings.center, angle);
            std::vector<BallInstance> turned = still;
            for (BallInstance& instance : turned) instance.center = turn(instance.center);
            return render_mesh_ball(turned, lighting, shader, volume, camera, view.settings);
        });
    }

#ifdef TETRALIGHT_HAS_GL
    Status render_gl(const ProbeVolumeView& volume, const Scene& scene, SceneLight light,
                     const Camera& camera) {
        auto spheres = GlMeshBall::make(ball.settings, scene, std::move(light), volume, 4096);
        if (!spheres) return spheres.error();
        return write_frames(camera, [&](double angle) -> Result<MeshBallPicture> {
            if (auto status = spheres->set_frame(angle, ball.light, ball.specular); !status) {
                return status.error();
            }
            const SphereInstances instances = spheres->sphere_instances();
            auto image =
                spheres->renderer().render(camera, view.settings, std::span(&instances, 1));
            if (!image) return image.error();
            return MeshBallPicture{std::move(*image), spheres->query_seconds()};
        });
    }
#endif

    Status write_frames(const Camera& camera, const Draw& draw) {
        const auto start = std::chrono::steady_clock::now();
        double query_seconds = 0.0;
        for (uint32_t frame = 0; frame < frame_count; ++frame) {
            const auto picture = draw(2.0 * std::numbers::pi * frame / frame_count);
            if (!picture) return picture.error();
            query_seconds = picture->query_seconds;
            auto status =
                write_png(picture_path(frame), develop(picture->image, view.settings.exposure));
            if (!status) return status;
        }
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        report(query_seconds, camera, elapsed.count());
        return Ok{};
    }

    void report(double query_seconds, const Camera& camera, double seconds) const {
        const std::string lit = ball.light == BallLight::Probes
                                    ? " lit by one batch query in " + duration(query_seconds)
                                : ball.light == BallLight::ProxyVolume
                                    ? std::string(" lit by a proxy volume")
                                    : std::string(" without probe light");
        common.report(output,
                      {{"output", output},
                       {"frames", frame_count},
                       {"instances", ball.settings.instance_count},
                       {"center", to_json(ball.settings.center)},
                       {"radius", ball.settings.radius},
                       {"eye", to_json(glm::dvec3(camera.world_from_camera[3]))},
                       {"query_seconds", query_seconds},
                       {"seconds", seconds}},
                      str_cat(output, ": ", counted(ball.settings.instance_count, "instance"), lit,
                              ", ", counted(frame_count, "picture"), " in ", duration(seconds)));
    }
};

}  // namespace

Status run_meshball(const Values& values) {
    return MeshBall(values).run();
}

}  // namespace tetralight::cli
