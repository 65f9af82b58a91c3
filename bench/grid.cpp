// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "bake/parallel.h"
#include "bake/placement/free_space.h"
#include "bake/placement/lattice.h"
#include "bake/ray_caster.h"
#include "bake/survey.h"
#include "bake/trace_scene.h"
#include "base/text.h"
#include "bench/grid_error.h"
#include "bench/grid_scenes.h"
#include "bench/harness.h"

namespace tetralight::bench {
namespace {

constexpr uint64_t kRegularCount = 4000;

/// A point of a curve of error over probes.
struct ErrorAt {
    double probe_count = 0.0;
    double error = 0.0;
};

/// Where the curve comes down to an error, on logarithmic axes; its end where it does not.
double count_for(const std::vector<ErrorAt>& curve, double error) {
    if (curve.front().error <= error) return curve.front().probe_count;
    for (size_t i = 1; i < curve.size(); ++i) {
        if (curve[i].error > error) continue;
        const auto& [n0, e0] = curve[i - 1];
        const auto& [n1, e1] = curve[i];
        const double t = std::log(e0 / error) / std::log(e0 / e1);
        return n0 * std::pow(n1 / n0, t);
    }
    return curve.back().probe_count;
}

/// Probes that adaptive grids need for the error of a lattice of 4000, over 4000.
double probes_for_error(const GridSubject& subject, const Options& options) {
    const size_t position_count = options.is_quick ? 4000 : 20'000;
    const uint32_t reference_samples = options.is_quick ? 512 : 2048;
    constexpr uint32_t kProbeSamples = 1024;
    const LightReference reference = make_reference(subject, position_count, reference_samples);
    const auto error_of = [&](const char* kind, uint64_t wanted, const ProbeGrid& grid) {
        const double error = light_error(subject, grid, reference, kProbeSamples);
        report(text("grid.error.", subject.name, ".", kind, ".", wanted), 100.0 * error,
               text("% with ", grid.probe_count(), " probes"));
        return ErrorAt{static_cast<double>(grid.probe_count()), error};
    };
    std::vector<uint64_t> counts{250, 500, 1000, 2000, 4000};
    if (options.is_quick) counts = {500, 1000, 2000};
    const double goal =
        error_of("regular", kRegularCount, regular_grid(subject, kRegularCount)).error;
    std::vector<ErrorAt> curve;
    for (const uint64_t count : counts) {
        curve.push_back(error_of("adaptive", count, adaptive_grid(subject, count)));
        if (options.is_quick && curve.back().error <= goal) break;
    }
    for (const uint64_t count : counts) {
        if (options.is_quick || count == kRegularCount) continue;
        error_of("regular", count, regular_grid(subject, count));
    }
    const double share = count_for(curve, goal) / static_cast<double>(kRegularCount);
    report("grid.probes_for_error." + subject.name, share, "of 4000 regular probes");
    return share;
}

/// Fates of a dense lattice in the house against the boxes that it is made of.
void inside() {
    const House house = make_house();
    const auto traced = TraceScene::make_static(house.scene);
    require(bool(traced), "scene");
    const Box bounds{{-2.0, -0.4, -2.0}, {14.0, 7.0, 10.0}};
    const auto lattice = make_lattice(bounds, glm::dvec3(0.183), 10'000'000);
    require(bool(lattice), "lattice");
    // What is nearer to a face than rounding is on it, neither in nor out.
    constexpr double kRounding = 2e-6;
    const std::vector<glm::dvec3> candidates = lattice->positions();
    std::vector<uint8_t> is_left_inside(candidates.size()), is_lost(candidates.size()),
        is_free(candidates.size());
    parallel_for(candidates.size(), 0, [&](size_t i) {
        is_free[i] = !house.is_inside(candidates[i], -kRounding);
        const bool is_deep = house.is_inside(candidates[i], kRounding);
        const Fate unmoved = place_probe(*traced, candidates[i], {}).fate;
        is_lost[i] = is_free[i] != 0 && !is_kept(unmoved);
        const PlacedProbe placed = place_probe(*traced, candidates[i], {0.02, 0.08});
        is_left_inside[i] = (is_kept(unmoved) && is_deep) ||
                            (is_kept(placed.fate) && house.is_inside(placed.position, kRounding));
    });
    const auto count = [](const std::vector<uint8_t>& flags) {
        return static_cast<double>(std::count(flags.begin(), flags.end(), 1));
    };
    report("grid.inside", count(is_left_inside), text("probes of ", candidates.size()));
    report("grid.inside.lost", 100.0 * count(is_lost) / count(is_free), "% of free candidates");
    require(count(is_left_inside) == 0.0, "no probe inside geometry");
}

/// All triangles of a scene for plain rays.
RayCaster plain_caster(const TraceScene& traced) {
    RayCaster caster;
    for (uint32_t g = 0; g < traced.geometry_count(); ++g) {
        std::vector<glm::vec3> corners;
        std::vector<uint32_t> indices;
        for (uint32_t p = 0; p < traced.triangle_count(g); ++p) {
            for (const glm::vec3& corner : traced.triangle(g, p)) {
                indices.push_back(static_cast<uint32_t>(corners.size()));
                corners.push_back(corner);
            }
        }
        caster.add_triangles(corners, indices);
    }
    require(bool(caster.commit()), "rays");
    return caster;
}

/// The rays of the inside test against the same rays alone.
void inside_rays(const GridSubject& subject, const Options& options) {
    const auto traced = TraceScene::make_static(subject.scene);
    require(bool(traced), "scene");
    const RayCaster caster = plain_caster(*traced);
    std::vector<glm::vec3> positions;
    for (const glm::dvec3& p : random_positions(4000, 5, 1.0)) {
        positions.push_back(
            traced->traced_from_world(subject.bounds.low + p * subject.bounds.size()));
    }
    const auto directions = survey_directions();
    Contest contest;
    contest.figure = "grid.inside_rays." + subject.name;
    contest.unit = "Mrays/s";
    contest.baseline_is = "the same rays by Embree alone";
    contest.work = 1e-6 * static_cast<double>(positions.size() * directions.size());
    contest.ours = [&] {
        return seconds([&] {
            size_t inside_count = 0;
            for (const glm::vec3& p : positions)
                inside_count += look_around(*traced, p).is_inside();
            require(inside_count < positions.size(), "free positions");
        });
    };
    contest.baseline = [&] {
        return seconds([&] {
            size_t hit_count = 0;
            for (const glm::vec3& p : positions) {
                for (const glm::vec3& d : directions) hit_count += caster.cast({p, d}).has_value();
            }
            require(hit_count > 0, "hits");
        });
    };
    run(contest, options);
}

/// Seconds for a lattice of a million candidates.
void a_million(const GridSubject& subject) {
    const auto traced = TraceScene::make_static(subject.scene);
    require(bool(traced), "scene");
    const glm::dvec3 size = subject.bounds.size();
    const auto lattice = make_lattice(
        subject.bounds, glm::dvec3(std::cbrt(size.x * size.y * size.z / 1e6)), 10'000'000);
    require(bool(lattice), "lattice");
    const std::vector<glm::dvec3> candidates = lattice->positions();
    std::vector<uint8_t> is_there(candidates.size());
    const double spacing = lattice->axes[0].spacing;
    const double time = seconds([&] {
        parallel_for(candidates.size(), 0, [&](size_t i) {
            is_there[i] =
                is_kept(place_probe(*traced, candidates[i], {0.1 * spacing, 0.45 * spacing}).fate);
        });
    });
    report("grid.classify_1m." + subject.name, time * 1e6 / static_cast<double>(candidates.size()),
           "s");
}

}  // namespace

void bench_grid(const Options& options) {
    inside();
    std::vector<double> shares;
    for (const GridSubject& subject : grid_subjects(options)) {
        inside_rays(subject, options);
        if (!options.is_quick) a_million(subject);
        shares.push_back(probes_for_error(subject, options));
    }
    report("grid.probes_for_error", median(shares), "of 4000 regular probes, median");
}

}  // namespace tetralight::bench
