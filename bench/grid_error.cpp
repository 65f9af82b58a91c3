// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/grid_error.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/free_space_map.h>
#include <tetralight/bake/placement/light_difference.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight::bench {
namespace {

constexpr double kOffSurface = 0.05;

/// Samples random positions of a scene.
class Places {
  public:
    Places(const GridSubject& subject, const TraceScene& traced)
        : bounds_(subject.bounds), traced_(traced) {
        double sum = 0.0;
        for (uint32_t g = 0; g < traced.geometry_count(); ++g) {
            for (uint32_t p = 0; p < traced.triangle_count(g); ++p) {
                const auto [a, b, c] = traced.triangle(g, p);
                sum += 0.5 * double{glm::length(glm::cross(b - a, c - a))};
                sums_.push_back(sum);
                triangles_.emplace_back(g, p);
            }
        }
    }

    [[nodiscard]] glm::dvec3 anywhere() {
        const double x = number_(engine_), y = number_(engine_), z = number_(engine_);
        return bounds_.min + bounds_.size() * glm::dvec3(x, y, z);
    }

    [[nodiscard]] glm::dvec3 off_a_surface() {
        const auto at = std::ranges::upper_bound(sums_, number_(engine_) * sums_.back());
        const size_t i = std::min<size_t>(at - sums_.begin(), sums_.size() - 1);
        const auto [a, b, c] = traced_.triangle(triangles_[i].first, triangles_[i].second);
        const auto root = static_cast<float>(std::sqrt(number_(engine_)));
        const auto v = static_cast<float>(number_(engine_));
        const glm::vec3 place = a + root * (1.0f - v) * (b - a) + root * v * (c - a);
        glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        if (traced_.is_double_sided(triangles_[i].first) && number_(engine_) < 0.5) {
            normal = -normal;
        }
        return traced_.world_from_render(place) + kOffSurface * glm::dvec3(normal);
    }

  private:
    WorldBox bounds_;
    const TraceScene& traced_;
    std::mt19937_64 engine_{99};
    std::uniform_real_distribution<double> number_{0.0, 1.0};
    std::vector<double> sums_;
    std::vector<std::pair<uint32_t, uint32_t>> triangles_;
};

/// The space that holds most probes of a coarse grid.
uint32_t largest_space(const GridSubject& subject, FreeSpaceMap& map) {
    const ProbeGrid grid = regular_grid(subject, 1000);
    map.join(grid.groups[0].positions);
    return map.space_of(grid.groups[0].positions[0]);
}

std::vector<glm::dvec3> free_positions(const GridSubject& subject, size_t count) {
    const auto traced = TraceScene::make_static(subject.scene);
    require(bool(traced), "scene");
    FreeSpaceMap map(*traced, subject.bounds, glm::dvec3(0.5));
    const uint32_t wanted = largest_space(subject, map);
    Places places(subject, *traced);
    std::vector<glm::dvec3> found;
    while (found.size() < count) {
        std::vector<glm::dvec3> some(4096);
        for (size_t i = 0; i < some.size(); ++i) {
            some[i] = i % 2 == 0 ? places.anywhere() : places.off_a_surface();
        }
        std::vector<uint8_t> is_free(some.size(), 0);
        parallel_for(some.size(), 0, [&](size_t i) {
            const glm::dvec3& p = some[i];
            if (p != p || glm::any(glm::lessThan(p, subject.bounds.min)) ||
                glm::any(glm::greaterThan(p, subject.bounds.max))) {
                return;
            }
            is_free[i] = !probe_visibility(*traced, traced->render_from_world(p)).is_inside() &&
                         map.space_of(p) == wanted;
        });
        // In pairs, so that there are equally many of both kinds.
        for (size_t i = 0; i + 1 < some.size() && found.size() + 1 < count; i += 2) {
            if (is_free[i] == 0 || is_free[i + 1] == 0) continue;
            found.insert(found.end(), {some[i], some[i + 1]});
        }
        if (found.size() + 1 >= count) break;
    }
    return found;
}

/// The root of the mean of squares, relative to the mean irradiance.
double relative(double square_sum, const std::vector<IrradianceSh>& light) {
    double sum = 0.0;
    for (const IrradianceSh& l : light) sum += mean_irradiance(l);
    const auto n = static_cast<double>(light.size());
    return std::sqrt(square_sum / n) / (sum / n);
}

}  // namespace

LightReference bake_reference(const Scene& scene, std::span<const glm::dvec3> positions,
                              uint32_t sample_count) {
    BakeSettings settings;
    settings.sample_count = sample_count;
    settings.seed = 77;
    const auto baked = bake_probes(scene, positions, settings);
    require(bool(baked), "bake");
    LightReference reference;
    double noise = 0.0;
    for (size_t i = 0; i < positions.size(); ++i) {
        reference.positions.emplace_back(positions[i]);
        reference.light.push_back(irradiance_from_radiance(baked->radiance[i]));
        const auto relative_error = static_cast<double>(baked->standard_error[i]);
        noise += relative_error * relative_error * mean_square(reference.light.back());
    }
    reference.noise = relative(noise, reference.light);
    return reference;
}

LightReference make_reference(const GridSubject& subject, size_t count, uint32_t sample_count) {
    return bake_reference(subject.scene, free_positions(subject, count), sample_count);
}

double light_error(const LightReference& reference, std::span<const IrradianceSh> answers) {
    require(answers.size() == reference.light.size(), "one answer a position");
    double sum = 0.0;
    for (size_t i = 0; i < answers.size(); ++i) {
        sum += mean_square(answers[i] + -1.0f * reference.light[i]);
    }
    const double error = relative(sum, reference.light);
    return std::sqrt(std::max(0.0, error * error - reference.noise * reference.noise));
}

double light_error(const GridSubject& subject, const ProbeGrid& grid,
                   const LightReference& reference, uint32_t sample_count) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = sample_count;
    const auto baked = bake_volume(subject.scene, grid.groups, settings);
    require(bool(baked), "bake");
    const ProbeVolumeView volume = baked->volume.view().without_compact();
    std::vector<IrradianceSh> answers(reference.positions.size());
    parallel_for(answers.size(), 0, [&](size_t i) {
        answers[i] = interpolate(volume, locate(volume, reference.positions[i])).irradiance;
    });
    return light_error(reference, answers);
}

ProbeGrid regular_grid(const GridSubject& subject, uint64_t probe_count) {
    ProbeGridSettings settings;
    settings.bounds = subject.bounds;
    const glm::dvec3 size = subject.bounds.size();
    double low = 0.0, high = 2.0 * std::max({size.x, size.y, size.z});
    double spacing = std::cbrt(size.x * size.y * size.z / static_cast<double>(probe_count));
    ProbeGrid best;
    for (int i = 0; i < 12; ++i) {
        settings.spacing = glm::dvec3(spacing);
        auto grid = make_probe_grid(subject.scene, settings);
        require(bool(grid), grid ? "" : error_text(grid.error()));
        const auto off = [&](const ProbeGrid& g) {
            return std::abs(static_cast<double>(g.probe_count()) -
                            static_cast<double>(probe_count));
        };
        (grid->probe_count() > probe_count ? low : high) = spacing;
        if (best.groups.empty() || off(*grid) < off(best)) best = std::move(*grid);
        if (off(best) < 0.01 * static_cast<double>(probe_count)) break;
        const double found = static_cast<double>(std::max<uint64_t>(best.probe_count(), 1));
        const double guess = i < 3 ? spacing * std::cbrt(found / static_cast<double>(probe_count))
                                   : 0.5 * (low + high);
        spacing = guess > low && guess < high ? guess : 0.5 * (low + high);
    }
    return best;
}

ProbeGrid adaptive_grid(const GridSubject& subject, uint64_t probe_count) {
    ProbeGridSettings settings;
    settings.mode = PlacementMode::Adaptive;
    settings.bounds = subject.bounds;
    settings.max_probes = probe_count;
    settings.adaptive.target_error = 1e-4;  // not reached, so that all probes are used
    auto grid = make_probe_grid(subject.scene, settings);
    require(bool(grid), grid ? "" : error_text(grid.error()));
    return std::move(*grid);
}

}  // namespace tetralight::bench
