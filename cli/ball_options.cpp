// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/ball_options.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include <tetralight/base/str_cat.h>

namespace tetralight::cli {

void BallOptions::add_to(CLI::App& command) {
    command.add_option("--count", settings.instance_count, "Spheres in the ball")
        ->check(CLI::Range(0u, 10'000'000u))
        ->capture_default_str();
    center_option_ =
        add_vec3(command, "--center", settings.center,
                 "Centre of the ball (default: of the probes, or a probe near it where the scene "
                 "leaves room)");
    radius_option_ = command.add_option("--radius", settings.radius,
                                        "Radius of the ball (default: from the probes)");
    radius_option_->check(numbers_in(1e-6, 1e9));
    add_seed(command, settings.seed, "Seed of places and colours");
    command.add_flag("--plain", settings.is_plain, "White, rough spheres, which show light alone");
    auto* lppv = command.add_flag_callback(
        "--lppv", [this] { light = BallLight::ProxyVolume; },
        "Light the spheres by a grid around the ball instead of one query each: they move without "
        "another query");
    command
        .add_flag_callback(
            "--off", [this] { light = BallLight::Off; }, "Leave their probe light out")
        ->excludes(lppv);
    command.add_flag_callback(
        "--specular", [this] { specular = Specular::On; },
        "Let them mirror the lights, and of the probes' light the direction that is brightest");
}

/// Where the ball may stand: in the middle of the probes, or at one of those that are nearest to
/// it, because probes stand where there is room.
std::vector<glm::dvec3> BallOptions::centers(const ProbeVolumeView& volume,
                                             const Box<glm::vec3>& bounds) const {
    constexpr size_t kMostProbes = 64;
    if (center_option_->count() > 0 || volume.positions.empty()) return {settings.center};
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
std::vector<double> BallOptions::radii(const ProbeVolumeView& volume,
                                       const Box<glm::vec3>& bounds) const {
    if (radius_option_->count() > 0 || volume.positions.empty()) return {settings.radius};
    const glm::dvec3 size(bounds.size());
    const double largest = 0.45 * std::max(std::min({size.x, size.y, size.z}), 1e-3);
    return {largest, 0.5 * largest, 0.25 * largest};
}

/// Floats hold the spheres' places: they have to be finer than the smallest sphere.
void BallOptions::check_center() const {
    const glm::dvec3 distance = glm::abs(settings.center);
    const double farthest = std::max({distance.x, distance.y, distance.z});
    const double smallest = 0.5 * settings.instance_size * settings.radius;
    const bool is_fine = smallest > farthest * std::numeric_limits<float>::epsilon();
    if (center_option_->count() == 0 || is_fine) return;
    throw CLI::ValidationError("--center", str_cat("floats cannot place spheres of ", smallest,
                                                   " m at ", farthest, " m from the origin"));
}

Camera BallOptions::place(const ProbeVolumeView& volume, const SceneShader* scene,
                          const ViewOptions& view) {
    const Box<glm::vec3> bounds = probe_bounds(volume);
    const BallView found = find_ball_view(view.has_camera ? nullptr : scene,
                                          centers(volume, bounds), radii(volume, bounds));
    settings.center = found.center;
    settings.radius = found.radius;
    check_center();
    return view.has_camera ? view.camera() : found.camera;
}

}  // namespace tetralight::cli
