// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/grid_inside.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/free_space.h>
#include <tetralight/bake/placement/lattice.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/rays/ray_caster.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/closed_solids.h>

namespace tetralight::bench {
namespace {

double spacing_for(const GridSubject& subject, double count) {
    const glm::dvec3 size = subject.bounds.size();
    return std::cbrt(size.x * size.y * size.z / count);
}

std::vector<glm::dvec3> lattice_of(const GridSubject& subject, double count) {
    const auto lattice =
        make_lattice(subject.bounds, glm::dvec3(spacing_for(subject, count)), 10'000'000);
    require(bool(lattice), "lattice");
    return lattice->positions();
}

/// Positions within this distance of a face count as neither inside nor outside.
bool is_on_a_surface(const TraceScene& traced, glm::vec3 position) {
    constexpr float kRounding = 1e-5f;
    const auto nearest = traced.nearest_surface(position);
    return nearest && glm::distance(*nearest, position) < kRounding;
}

/// The fate of one candidate.
struct Verdict {
    bool is_free = false;      ///< beyond doubt
    bool is_lost = false;      ///< it is, and was dropped
    uint32_t left_inside = 0;  ///< probes
};

/// Fates of a dense lattice, with and without pushing, against the winding number. Returns how many
/// probes are left inside closed meshes.
double inside(const GridSubject& subject, const Options& options) {
    const auto traced = TraceScene::make_static(subject.scene);
    require(bool(traced), "scene");
    const ClosedSolids solids(*traced);
    const double spacing = spacing_for(subject, 4000.0);
    const ClearanceRule rules[] = {{}, {0.02, 0.08}, {0.1 * spacing, 0.45 * spacing}};
    const std::vector<glm::dvec3> candidates =
        lattice_of(subject, options.is_quick ? 20'000.0 : 200'000.0);
    std::vector<Verdict> verdicts(candidates.size());
    parallel_for(candidates.size(), 0, [&](size_t i) {
        const glm::vec3 here = traced->render_from_world(candidates[i]);
        Verdict& verdict = verdicts[i];
        verdict.is_free =
            !is_on_a_surface(*traced, here) && !solids.hold(here) && solids.decide(here);
        for (const ClearanceRule& rule : rules) {
            const PlacedProbe placed = place_probe(*traced, candidates[i], rule);
            const glm::vec3 there = traced->render_from_world(placed.position);
            verdict.is_lost |= verdict.is_free && rule.clearance == 0.0 && !is_kept(placed.fate);
            verdict.left_inside +=
                is_kept(placed.fate) && solids.hold(there) && !is_on_a_surface(*traced, there);
        }
    });
    double left = 0.0, lost = 0.0, free = 0.0;
    for (const Verdict& verdict : verdicts) {
        left += verdict.left_inside;
        lost += verdict.is_lost ? 1.0 : 0.0;
        free += verdict.is_free ? 1.0 : 0.0;
    }
    report("grid.inside." + subject.name, left,
           str_cat("probes of 3 x ", candidates.size(), ", in ", solids.count(), " closed meshes"));
    report("grid.lost." + subject.name, 100.0 * lost / free, str_cat("% of ", free, " candidates"));
    return left;
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
            traced->render_from_world(subject.bounds.min + p * subject.bounds.size()));
    }
    const auto directions = probe_visibility_directions();
    Contest contest;
    contest.figure = "grid.inside_rays." + subject.name;
    contest.unit = "Mrays/s";
    contest.baseline_is = "the same rays by Embree alone";
    contest.work = 1e-6 * static_cast<double>(positions.size() * directions.size());
    contest.ours = [&] {
        return seconds([&] {
            size_t inside_count = 0;
            for (const glm::vec3& p : positions)
                inside_count += probe_visibility(*traced, p).is_inside();
            require(inside_count < positions.size(), "free positions");
        });
    };
    contest.baseline = [&] {
        return seconds([&] {
            size_t hit_count = 0;
            for (const glm::vec3& p : positions) {
                for (const glm::vec3& d : directions)
                    hit_count += caster.intersect({p, d}).has_value();
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
    const std::vector<glm::dvec3> candidates = lattice_of(subject, 1e6);
    const double spacing = spacing_for(subject, 1e6);
    std::vector<uint8_t> is_there(candidates.size());
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

double measure_inside(const GridSubject& subject, const Options& options) {
    const double left = inside(subject, options);
    inside_rays(subject, options);
    if (!options.is_quick) a_million(subject);
    return left;
}

double count_inside(const GridSubject& subject, const ProbeGrid& grid) {
    const auto traced = TraceScene::make_static(subject.scene);
    require(bool(traced), "scene");
    const ClosedSolids solids(*traced);
    double count = 0.0;
    for (const ProbeGroup& group : grid.groups) {
        for (const glm::dvec3& position : group.positions) {
            const glm::vec3 place = traced->render_from_world(position);
            count += solids.hold(place) && !is_on_a_surface(*traced, place) ? 1.0 : 0.0;
        }
    }
    return count;
}

}  // namespace tetralight::bench
