// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/ball_options.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include <tetralight/base/str_cat.h>

namespace tetralight::cli {

BallOptions::BallOptions(const Values& values)
    : values_(&values),
      has_center_(values.is_given("center")),
      has_radius_(values.is_given("radius")) {
    settings.instance_count = values.integer32("count");
    if (has_center_) settings.center = vec3(values, "center");
    if (has_radius_) settings.radius = values.number("radius");
    settings.seed = values.integer("seed");
    settings.is_plain = values.flag("plain");
    if (values.is_given("roughness"))
        settings.metal_roughness = static_cast<float>(values.number("roughness"));
    if (values.flag("lppv")) light = BallLight::ProxyVolume;
    if (values.flag("off")) light = BallLight::Off;
    if (values.flag("specular")) specular = Specular::On;
}

/// Candidates for the center of the ball: the center of the probes, and the probes that are nearest
/// to it, because probes have room around them.
std::vector<glm::dvec3> BallOptions::centers(const ProbeVolumeView& volume,
                                             const Box<glm::vec3>& bounds) const {
    constexpr size_t kMostProbes = 64;
    if (has_center_ || volume.positions.empty()) return {settings.center};
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

/// Candidates for the radius: from the bounds of the probes, and smaller ones for narrow places.
std::vector<double> BallOptions::radii(const ProbeVolumeView& volume,
                                       const Box<glm::vec3>& bounds) const {
    if (has_radius_ || volume.positions.empty()) return {settings.radius};
    const glm::dvec3 size(bounds.size());
    const double largest = 0.45 * std::max(std::min({size.x, size.y, size.z}), 1e-3);
    return {largest, 0.5 * largest, 0.25 * largest};
}

/// Positions of spheres are floats: their spacing has to be smaller than the smallest sphere.
void BallOptions::check_center() const {
    const glm::dvec3 distance = glm::abs(settings.center);
    const double farthest = std::max({distance.x, distance.y, distance.z});
    const double smallest = 0.5 * settings.instance_size * settings.radius;
    const bool is_fine = smallest > farthest * std::numeric_limits<float>::epsilon();
    if (!has_center_ || is_fine) return;
    refuse(*values_, "center",
           str_cat("floats cannot place spheres of ", smallest, " m at ", farthest,
                   " m from the origin"));
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
