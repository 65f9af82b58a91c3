// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/grid_places.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <span>
#include <utility>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/base/error_text.h>
#include <tetralight/bench/grid_reach.h>

namespace tetralight::bench {
namespace {

constexpr double kNearest = 0.05, kFarthest = 0.25;

/// Samples random positions of a scene.
class Sampler {
  public:
    Sampler(const GridSubject& subject, const TraceScene& traced)
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
        const double distance = kNearest + (kFarthest - kNearest) * number_(engine_);
        return traced_.world_from_render(place) + distance * glm::dvec3(normal);
    }

  private:
    WorldBox bounds_;
    const TraceScene& traced_;
    std::mt19937_64 engine_{99};
    std::uniform_real_distribution<double> number_{0.0, 1.0};
    std::vector<double> sums_;
    std::vector<std::pair<uint32_t, uint32_t>> triangles_;
};

TraceScene trace(const Scene& scene) {
    auto traced = TraceScene::make_static(scene);
    require(bool(traced), traced ? "" : error_text(traced.error()));
    return std::move(*traced);
}

/// True if most of the positions are outside geometry, and light reaches most of them.
bool is_lit_and_free(const Scene& scene, std::span<const glm::dvec3> positions) {
    BakeSettings settings;
    settings.sample_count = 256;
    const auto visible = probe_visibilities(scene, positions);
    const auto baked = bake_probes(scene, positions, settings);
    require(visible && baked, "light of a space");
    size_t count = 0;
    for (size_t i = 0; i < positions.size(); ++i) {
        count += !(*visible)[i].is_inside() && baked->radiance[i] != RadianceSh{};
    }
    return 2 * count > positions.size();
}

bool is_in(const WorldBox& box, const glm::dvec3& p) {
    return glm::all(glm::greaterThanEqual(p, box.min)) && glm::all(glm::lessThanEqual(p, box.max));
}

}  // namespace

struct ReachablePlaces::State {
    explicit State(const GridSubject& subject)
        : bounds(subject.bounds),
          traced(trace(subject.scene)),
          space(traced, bounds, subject.from,
                [&](auto positions) { return is_lit_and_free(subject.scene, positions); }),
          sampler(subject, traced) {}

    [[nodiscard]] bool is_usable(const glm::dvec3& p) const {
        if (!is_in(bounds, p)) return false;  // normals of triangles without area are not numbers
        const glm::vec3 here = traced.render_from_world(p);
        const auto surface = traced.nearest_surface(here);
        if (surface && double{glm::distance(*surface, here)} < kNearest) return false;
        return space.contains(p) && !probe_visibility(traced, here).is_inside();
    }

    WorldBox bounds;
    TraceScene traced;
    ReachableSpace space;
    Sampler sampler;
};

ReachablePlaces::ReachablePlaces(const GridSubject& subject)
    : state_(std::make_unique<State>(subject)) {}

ReachablePlaces::~ReachablePlaces() = default;

std::vector<glm::dvec3> ReachablePlaces::next(size_t count) {
    constexpr int kMostBatches = 2000;
    std::vector<glm::dvec3> anywhere, off_surfaces;
    for (int batch = 0; batch < kMostBatches; ++batch) {
        std::vector<glm::dvec3> some(4096);
        for (size_t i = 0; i < some.size(); ++i) {
            some[i] = i % 2 == 0 ? state_->sampler.anywhere() : state_->sampler.off_a_surface();
        }
        std::vector<uint8_t> is_usable(some.size(), 0);
        parallel_for(some.size(), 0, [&](size_t i) { is_usable[i] = state_->is_usable(some[i]); });
        for (size_t i = 0; i < some.size(); ++i) {
            std::vector<glm::dvec3>& kind = i % 2 == 0 ? anywhere : off_surfaces;
            if (is_usable[i] != 0 && 2 * kind.size() < count) kind.push_back(some[i]);
        }
        if (2 * std::min(anywhere.size(), off_surfaces.size()) >= count) {
            anywhere.insert(anywhere.end(), off_surfaces.begin(), off_surfaces.end());
            return anywhere;
        }
    }
    require(false, "reachable places off surfaces");
    return {};
}

}  // namespace tetralight::bench
