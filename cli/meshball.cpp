// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <optional>

#include "bake/image/write_image.h"
#include "bake/scene/read_gltf.h"
#include "base/text.h"
#include "cli/common.h"
#include "cli/paths.h"
#include "cli/view_options.h"
#include "pipeline/ball_view.h"
#include "pipeline/mesh_ball.h"
#include "probes/probe_file.h"

namespace tetralight::cli {
namespace {

struct MeshBall {
    std::string volume_path;
    std::string scene_path;
    std::string output;
    MeshBallSettings settings;
    CLI::Option* center_option = nullptr;
    CLI::Option* radius_option = nullptr;
    ViewOptions view;
    CommonOptions common;

    void add_to(CLI::App& command) {
        add_path(command, "VOLUME", volume_path, "Probe volume (.probes)")->required();
        add_output(command, output, ".png", "Picture to write");
        add_path(command, "--scene", scene_path, "glTF 2.0 scene to show around the ball");
        command.add_option("--count", settings.instance_count, "Spheres in the ball")
            ->check(CLI::Range(0u, 10'000'000u))
            ->capture_default_str();
        center_option = add_vec3(
            command, "--center", settings.center,
            "Centre of the ball (default: of the probes, or a probe near it where the scene "
            "leaves room)");
        radius_option = command.add_option("--radius", settings.radius,
                                           "Radius of the ball (default: from the probes)");
        radius_option->check(numbers_in(1e-6, 1e9));
        add_seed(command, settings.seed, "Seed of places and colours");
        view.add_to(command);
        common.add_to(command);
    }

    /// Where the ball may stand: in the middle of the probes, or at one of those that are nearest
    /// to it, because probes stand where there is room.
    [[nodiscard]] std::vector<glm::dvec3> centers(const ProbeVolumeView& volume,
                                                  const ProbeBounds& bounds) const {
        constexpr size_t kMostProbes = 64;
        if (center_option->count() > 0 || volume.positions.empty()) return {settings.center};
        std::vector<glm::vec3> nearest(kMostProbes);
        const auto distance = [&](glm::vec3 p) { return glm::distance(p, bounds.center()); };
        nearest.erase(
            std::ranges::partial_sort_copy(volume.positions, nearest, {}, distance, distance).out,
            nearest.end());
        std::vector<glm::dvec3> centers{volume.info.world_origin + glm::dvec3(bounds.center())};
        for (const glm::vec3& p : nearest) {
            centers.push_back(volume.info.world_origin + glm::dvec3(p));
        }
        return centers;
    }

    /// From the probes' bounds, and smaller ones for where there is little room.
    [[nodiscard]] std::vector<double> radii(const ProbeVolumeView& volume,
                                            const ProbeBounds& bounds) const {
        if (radius_option->count() > 0 || volume.positions.empty()) return {settings.radius};
        const glm::dvec3 size(bounds.high - bounds.low);
        const double largest = 0.45 * std::max(std::min({size.x, size.y, size.z}), 1e-3);
        return {largest, 0.5 * largest, 0.25 * largest};
    }

    /// The ball fills the middle of the probes unless the user placed it, and the camera sees it
    /// unless the user placed that.
    [[nodiscard]] Camera place(const ProbeVolumeView& volume, const SceneShader* scene) {
        const ProbeBounds bounds = probe_bounds(volume);
        const BallView found = find_ball_view(view.has_camera ? nullptr : scene,
                                              centers(volume, bounds), radii(volume, bounds));
        settings.center = found.center;
        settings.radius = found.radius;
        return view.has_camera ? view.camera() : found.camera;
    }

    Status run() {
        if (auto status = check_output(output, {volume_path, scene_path}); !status) return status;
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        common.warn_if_unlit(volume_path, file->view());
        Scene scene;
        std::optional<SceneShader> shader;
        if (!scene_path.empty()) {
            auto read = read_gltf(scene_path);
            if (!read) return read.error();
            common.warn(read->warnings);
            scene = std::move(*read);
            auto made = SceneShader::make(scene, file->view());
            if (!made) return made.error();
            shader.emplace(std::move(*made));
        }
        return render(file->view(), shader ? &*shader : nullptr);
    }

    Status render(const ProbeVolumeView& volume, const SceneShader* scene) {
        const Camera camera = place(volume, scene);
        view.settings.thread_count = common.thread_count;
        const auto start = std::chrono::steady_clock::now();
        const auto instances = make_mesh_ball(settings);
        const auto picture = render_mesh_ball(instances, scene, volume, camera, view.settings);
        if (!picture) return picture.error();
        auto status = write_png(output, develop(picture->image, view.settings.exposure));
        if (!status) return status;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        report(*picture, camera, elapsed.count());
        return Ok{};
    }

    void report(const MeshBallPicture& picture, const Camera& camera, double seconds) const {
        common.report(output,
                      {{"output", output},
                       {"instances", settings.instance_count},
                       {"center", to_json(settings.center)},
                       {"radius", settings.radius},
                       {"eye", to_json(glm::dvec3(camera.world_from_camera[3]))},
                       {"query_seconds", picture.query_seconds},
                       {"seconds", seconds}},
                      text(output, ": ", counted(settings.instance_count, "instance"),
                           " lit by one batch query in ", duration(picture.query_seconds),
                           ", picture in ", duration(seconds)));
    }
};

}  // namespace

void add_meshball(CLI::App& app, Run& run) {
    add_command<MeshBall>(app, run, "meshball",
                          "Render 1023 spheres lit by one batch query of a probe volume",
                          "tetralight meshball courtyard.probes --scene courtyard.glb -o ball.png");
}

}  // namespace tetralight::cli
