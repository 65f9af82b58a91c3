// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/lppv_accuracy.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/base/error_text.h>
#include <tetralight/bench/grid_scenes.h>
#include <tetralight/lppv/lppv.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight::bench {
namespace {

/// An object, and its grid: points 0.5 m apart along it, 0.3 m across.
constexpr glm::dvec3 kBeam{10.0, 0.6, 0.6};
constexpr glm::uvec3 kResolution{21, 3, 3};
constexpr size_t kBeamCount = 40;
constexpr double kProbeSpacing = 2.0;  ///< of scenes without probe groups
constexpr double kSurfaceStep = 0.1;

struct SurfacePoint {
    glm::dvec3 position{0.0};
    glm::vec3 normal{0.0f};
};

/// Points on the sides of a beam.
std::vector<SurfacePoint> points_on(const glm::dmat4& world_from_beam) {
    std::vector<SurfacePoint> points;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const auto rows = static_cast<int>(std::round(kBeam[u] / kSurfaceStep));
        const auto columns = static_cast<int>(std::round(kBeam[v] / kSurfaceStep));
        for (int i = 0; i < 2 * rows * columns; ++i) {
            const double side = i % 2 == 0 ? 0.5 : -0.5;
            glm::dvec3 local(0.0), normal(0.0);
            local[axis] = side * kBeam[axis];
            local[u] = kBeam[u] * ((i / 2 % rows + 0.5) / rows - 0.5);
            local[v] = kBeam[v] * ((i / 2 / rows + 0.5) / columns - 0.5);
            normal[axis] = 2.0 * side;
            points.push_back({glm::dvec3(world_from_beam * glm::dvec4(local, 1.0)),
                              glm::vec3(world_from_beam * glm::dvec4(normal, 0.0))});
        }
    }
    return points;
}

/// The points of a surface that are not inside geometry, where they cannot be seen.
std::vector<SurfacePoint> visible(const Scene& scene, const std::vector<SurfacePoint>& points) {
    std::vector<glm::dvec3> positions;
    for (const SurfacePoint& point : points) positions.push_back(point.position);
    const auto visibility = probe_visibilities(scene, positions);
    require(bool(visibility), "survey");
    std::vector<SurfacePoint> free;
    for (size_t i = 0; i < points.size(); ++i) {
        if (!(*visibility)[i].is_inside()) free.push_back(points[i]);
    }
    return free;
}

ProbeVolume bake(const GridSubject& subject) {
    std::vector<ProbeGroup> groups = subject.scene.probe_groups;
    if (groups.empty()) {
        ProbeGridSettings grid;
        grid.spacing = glm::dvec3(kProbeSpacing);
        auto made = make_probe_grid(subject.scene, grid);
        require(bool(made), made ? "" : error_text(made.error()));
        groups = std::move(made->groups);
    }
    BakeVolumeSettings settings;
    settings.bake.sample_count = 4096;
    auto baked = bake_volume(subject.scene, groups, settings);
    require(bool(baked), baked ? "" : error_text(baked.error()));
    return std::move(baked->volume);
}

/// Relative RMSE of irradiance on the surfaces of beams.
class Accuracy {
  public:
    Accuracy(const Scene& scene, const ProbeVolumeView& volume) : scene_(scene), volume_(volume) {}

    void add_beam(const glm::dmat4& world_from_beam) {
        const LppvPart part{world_from_beam, -0.5 * kBeam, 0.5 * kBeam};
        LppvSettings settings;
        settings.resolution_mode = LppvResolution::Custom;
        settings.resolution = kResolution;
        const auto grid = make_lppv_grid({world_from_beam, std::span(&part, 1)}, settings);
        require(bool(grid), "grid");
        std::array<Lppv, 3> lppvs;
        for (size_t i = 0; i < lppvs.size(); ++i) {
            lppvs[i] = *make_lppv(volume_, *grid, {.quality = static_cast<LppvQuality>(i)});
        }
        const IrradianceSh single = light_at(glm::vec3(world_from_beam[3]));
        for (const SurfacePoint& point : visible(scene_, points_on(world_from_beam))) {
            const glm::vec3 position(point.position);
            const glm::vec3 expected = evaluate_irradiance(light_at(position), point.normal);
            square_sum_ += glm::dot(glm::dvec3(expected), glm::dvec3(expected));
            const auto add = [&](double& sum, const IrradianceSh& light) {
                const glm::dvec3 difference(evaluate_irradiance(light, point.normal) - expected);
                sum += glm::dot(difference, difference);
            };
            for (size_t i = 0; i < lppvs.size(); ++i) {
                add(sums_[i], sample_lppv(lppvs[i], position).irradiance);
            }
            add(single_, single);
        }
    }

    void report_all() const {
        constexpr std::array<const char*, 3> kNames{"low", "normal", "full"};
        for (size_t i = kNames.size(); i-- > 0;) {
            report(std::string("lppv.accuracy.") + kNames[i], error(sums_[i]), "relative RMSE");
        }
        report("lppv.accuracy.single", error(single_), "relative RMSE");
    }

  private:
    [[nodiscard]] IrradianceSh light_at(const glm::vec3& position) const {
        return interpolate(volume_, locate(volume_, position)).irradiance;
    }

    [[nodiscard]] double error(double sum) const { return std::sqrt(sum / square_sum_); }

    const Scene& scene_;
    const ProbeVolumeView& volume_;
    std::array<double, 3> sums_{};
    double single_ = 0.0;
    double square_sum_ = 0.0;
};

/// Horizontal beams with random rotation at random positions in the probes' box.
std::vector<glm::dmat4> random_beams(const ProbeVolumeView& volume) {
    glm::dvec3 low(volume.positions[0]), high = low;
    for (const glm::vec3& p : volume.positions) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    std::vector<glm::dmat4> beams;
    for (const glm::dvec3& p : random_positions(100 * kBeamCount, 5, 1.0)) {
        const double angle = p.x * 1000.0;
        const glm::dvec3 center = glm::mix(low, high, p);
        const glm::dvec3 reach =
            0.5 *
            glm::dvec3(kBeam.x * std::abs(std::cos(angle)) + kBeam.z * std::abs(std::sin(angle)),
                       kBeam.y,
                       kBeam.x * std::abs(std::sin(angle)) + kBeam.z * std::abs(std::cos(angle)));
        const bool is_inside = glm::all(glm::greaterThan(center - reach, low)) &&
                               glm::all(glm::lessThan(center + reach, high));
        if (!is_inside) continue;
        beams.push_back(
            glm::rotate(glm::translate(glm::dmat4(1.0), center), angle, glm::dvec3(0, 1, 0)));
        if (beams.size() == kBeamCount) return beams;
    }
    require(false, "the probes' box has room for a beam");
    return {};
}

}  // namespace

void bench_lppv_accuracy(const Options& options) {
    const std::vector<GridSubject> subjects = grid_subjects(options);
    const GridSubject& subject = options.scene ? subjects.back() : subjects.front();
    const ProbeVolume volume = bake(subject);
    const ProbeVolumeView view = volume.view();
    Accuracy accuracy(subject.scene, view);
    for (const glm::dmat4& beam : random_beams(view)) accuracy.add_beam(beam);
    accuracy.report_all();
}

}  // namespace tetralight::bench
