// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include "bake/image/write_image.h"
#include "bake/scene/read_gltf.h"
#include "base/text.h"
#include "cli/common.h"
#include "cli/paths.h"
#include "cli/view_options.h"
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
        center_option = add_vec3(command, "--center", settings.center,
                                 "Centre of the ball (default: of the probes)");
        radius_option = command.add_option("--radius", settings.radius,
                                           "Radius of the ball (default: from the probes)");
        radius_option->check(numbers_in(1e-6, 1e9));
        add_seed(command, settings.seed, "Seed of places and colours");
        view.add_to(command);
        common.add_to(command);
    }

    /// The ball fills the middle of the probes unless the user placed it.
    void place_in(const ProbeVolumeView& volume) {
        if (volume.positions.empty()) return;
        glm::vec3 low = volume.positions[0];
        glm::vec3 high = volume.positions[0];
        for (const glm::vec3& p : volume.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const glm::dvec3 size(high - low);
        if (center_option->count() == 0) {
            settings.center = volume.info.world_origin + glm::dvec3(low + high) * 0.5;
        }
        if (radius_option->count() == 0) {
            settings.radius = 0.45 * std::max(std::min({size.x, size.y, size.z}), 1e-3);
        }
    }

    [[nodiscard]] Camera camera() const {
        if (view.has_camera) return view.camera();
        const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, 0.25, 1.0));
        return look_at(settings.center + direction * (3.2 * settings.radius), settings.center,
                       glm::radians(45.0));
    }

    Status run() {
        if (auto status = check_output(output, {volume_path, scene_path}); !status) return status;
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        common.warn_if_unlit(volume_path, file->view());
        std::optional<Scene> scene;
        if (!scene_path.empty()) {
            auto read = read_gltf(scene_path);
            if (!read) return read.error();
            common.warn(read->warnings);
            scene = std::move(*read);
        }
        place_in(file->view());
        view.settings.thread_count = common.thread_count;

        const auto start = std::chrono::steady_clock::now();
        const auto instances = make_mesh_ball(settings);
        const auto picture = render_mesh_ball(instances, scene ? &*scene : nullptr, file->view(),
                                              camera(), view.settings);
        if (!picture) return picture.error();
        auto status = write_png(output, develop(picture->image, view.settings.exposure));
        if (!status) return status;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        report(*picture, elapsed.count());
        return Ok{};
    }

    void report(const MeshBallPicture& picture, double seconds) const {
        common.report(output,
                      {{"output", output},
                       {"instances", settings.instance_count},
                       {"query_seconds", picture.query_seconds},
                       {"pack_seconds", picture.pack_seconds},
                       {"seconds", seconds}},
                      text(output, ": ", grouped(settings.instance_count),
                           " instances lit by one batch query in ", duration(picture.query_seconds),
                           " (+ packing ", duration(picture.pack_seconds), "), picture in ",
                           duration(seconds)));
    }
};

}  // namespace

void add_meshball(CLI::App& app, Run& run) {
    add_command<MeshBall>(app, run, "meshball",
                          "Render 1023 spheres lit by one batch query of a probe volume",
                          "tetralight meshball courtyard.probes --scene courtyard.glb -o ball.png");
}

}  // namespace tetralight::cli
