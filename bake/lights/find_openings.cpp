// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/find_openings.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <optional>

#include <tetralight/bake/lights/fit_holes.h>
#include <tetralight/bake/sampling/mix.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/sampling/sobol.h>

namespace tetralight {
namespace {

/// Places on surfaces at first, and rays that tell whether a place is enclosed: at most
/// `kMaxEscaped` of them escape.
constexpr uint32_t kPlaces = 2048, kRaysPerPlace = 16, kMaxEscaped = 4;

/// At least so many escape from an open place.
constexpr uint32_t kMinEscaped = 6;

/// Steps of walks from enclosed places, in all.
constexpr uint32_t kSteps = 60'000;
constexpr uint32_t kStepsPerWalk = 16;

/// Steps that take as long as the search of a ray.
constexpr uint32_t kStepsPerSearch = 16;

constexpr float kEndless = std::numeric_limits<float>::infinity();

/// Most rays that are kept.
constexpr size_t kMaxRays = 768;

/// No triangle gets more than this share of the places.
constexpr double kMaxShare = 1.0 / 64.0;

/// Ratio of the clearance before and behind an opening to that in it, at least: the open side of a
/// room, or a place along a corridor, is none.
constexpr float kMinWidening = 1.5f;

// Metres, times the scale.
constexpr float kStep = 0.1f;          ///< between positions along a ray
constexpr float kMaxClearance = 2.5f;  ///< half of the width of an opening
constexpr float kMaxLength = 40.0f;    ///< of the part of a ray that is searched
constexpr float kLink = 0.75f;         ///< largest distance of neighbors in an opening
constexpr float kMaxArea = 10.0f;      ///< m²; larger openings are met by chance
constexpr size_t kMinPoints = 6;

constexpr size_t kMaxOpenings = 4 * Openings::kMaxCount;

struct Place {
    glm::vec3 origin{0.0f};  ///< of rays
    glm::vec3 normal{0.0f};
};

class Finder {
  public:
    explicit Finder(const TraceScene& trace_scene) : trace_scene_(trace_scene) {}

    std::vector<Opening> find() {
        measure();
        if (triangles_.empty()) return {};
        find_enclosed();
        if (enclosed_.empty()) return {};
        find_scale();
        walk();
        return cluster();
    }

  private:
    struct Triangle {
        std::array<glm::vec3, 3> corners;
        double end = 0.0;  ///< cumulative weight
    };

    void measure() {
        std::vector<double> areas;
        for (uint32_t g = 0; g < trace_scene_.geometry_count(); ++g) {
            for (uint32_t i = 0; i < trace_scene_.triangle_count(g); ++i) {
                const auto corners = trace_scene_.triangle(g, i);
                const double area =
                    0.5 * glm::length(glm::cross(glm::dvec3(corners[1]) - glm::dvec3(corners[0]),
                                                 glm::dvec3(corners[2]) - glm::dvec3(corners[0])));
                if (!(area > 0.0) || !std::isfinite(area)) continue;
                triangles_.push_back({corners});
                areas.push_back(area);
            }
        }
        if (areas.empty()) return;
        // Lower the largest areas until none has more than its share.
        double limit = *std::ranges::max_element(areas);
        for (int i = 0; i < 64; ++i) {
            double sum = 0.0;
            for (const double area : areas) sum += std::min(area, limit);
            if (limit <= kMaxShare * sum * 1.01 || areas.size() < 64) break;
            limit = kMaxShare * sum;
        }
        double end = 0.0;
        for (size_t i = 0; i < areas.size(); ++i)
            triangles_[i].end = end += std::min(areas[i], limit);
    }

    [[nodiscard]] std::optional<SurfaceSide> intersect(const Ray& ray) const {
        return trace_scene_.intersect_side(ray);
    }

    /// The hit point, as the origin of the next ray; none if the ray hit a back face.
    [[nodiscard]] std::optional<Place> place_of(const Ray& ray,
                                                const std::optional<SurfaceSide>& side) const {
        if (!side || side->is_back_face) return std::nullopt;
        const glm::vec3 hit = ray.origin + side->distance * ray.direction;
        return Place{trace_scene_.ray_origin(*side, hit, side->normal), side->normal};
    }

    /// How many of some rays escape.
    [[nodiscard]] uint32_t escaped(const Place& place, uint64_t key,
                                   uint32_t ray_count = kRaysPerPlace) const {
        uint32_t count = 0;
        for (uint32_t i = 0; i < ray_count; ++i) {
            Sampler sampler(key, i);
            const glm::vec3 direction = sample_cosine_hemisphere(place.normal, sampler.next2());
            if (!intersect({place.origin, direction})) ++count;
        }
        return count;
    }

    void find_enclosed() {
        for (uint32_t i = 0; i < kPlaces; ++i) {
            Sampler sampler(1, i);
            const double chosen = sampler.next_double() * triangles_.back().end;
            const auto it = std::ranges::upper_bound(triangles_, chosen, {}, &Triangle::end);
            const Triangle& triangle = it == triangles_.end() ? triangles_.back() : *it;
            const glm::vec2 u = sampler.next2();
            const float root = std::sqrt(u.x);
            const glm::vec3 position = triangle.corners[0] * (1.0f - root) +
                                       triangle.corners[1] * (root * (1.0f - u.y)) +
                                       triangle.corners[2] * (root * u.y);
            const glm::vec3 across = glm::cross(triangle.corners[1] - triangle.corners[0],
                                                triangle.corners[2] - triangle.corners[0]);
            const glm::vec3 normal = glm::normalize(across);
            const float height = 1e-3f * std::sqrt(glm::length(across));
            const Ray ray{position + height * normal, -normal, 2.0f * height};
            const auto place = place_of(ray, intersect(ray));
            if (place && escaped(*place, detail::mix(i)) <= kMaxEscaped)
                enclosed_.push_back(*place);
        }
    }

    /// Scenes are in metres, but for rooms of a size that no house has. The size is one that a
    /// tenth of rays exceed: many are short, between parts of walls that overlap for example.
    void find_scale() {
        constexpr float kUsual = 4.5f, kLeast = 1.0f, kMost = 50.0f;
        std::vector<float> lengths;
        for (size_t i = 0; i < enclosed_.size(); ++i) {
            Sampler sampler(4, static_cast<uint32_t>(i));
            const Ray ray{enclosed_[i].origin,
                          sample_cosine_hemisphere(enclosed_[i].normal, sampler.next2())};
            if (const auto side = intersect(ray)) lengths.push_back(side->distance);
        }
        if (lengths.empty()) return;
        const auto size = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() * 9 / 10);
        std::ranges::nth_element(lengths, size);
        if (*size < kLeast || *size > kMost) scale_ = *size / kUsual;
    }

    /// Walks from enclosed places and keeps where their rays are narrow before they escape.
    void walk() {
        uint32_t steps = 0;
        for (uint32_t i = 0; steps < kSteps && narrow_.size() < kMaxRays; ++i) {
            Place place = enclosed_[i % enclosed_.size()];
            Sampler sampler(2, i);
            for (uint32_t step = 0; step < kStepsPerWalk; ++step) {
                ++steps;
                const Ray ray{place.origin,
                              sample_cosine_hemisphere(place.normal, sampler.next2())};
                const auto surface = intersect(ray);
                const auto next = place_of(ray, surface);
                if (surface && !next) break;
                if (!next || is_open(*next, i + step)) {
                    steps += kStepsPerSearch;
                    if (escaped(place, detail::mix(~uint64_t{i})) <= kMaxEscaped)
                        search(ray, next ? glm::distance(next->origin, ray.origin) : kEndless);
                    break;
                }
                place = *next;
            }
        }
    }

    /// Asks four rays first.
    [[nodiscard]] bool is_open(const Place& place, uint64_t key) const {
        return escaped(place, detail::mix(key), 4) >= 2 &&
               escaped(place, detail::mix(~key)) >= kMinEscaped;
    }

    /// Keeps the narrowest place of a ray that has more room before and behind.
    void search(const Ray& ray, float length) {
        const float step = kStep * scale_;
        const float reach = kMaxClearance * scale_;
        const auto clearance = [&](float distance) {
            const glm::vec3 position = ray.origin + distance * ray.direction;
            const auto nearest = trace_scene_.nearest_surface(position, reach);
            return nearest ? glm::distance(position, *nearest) : reach;
        };
        float narrowest = reach, at = -1.0f;
        bool is_falling = false;
        float peak = 0.0f;                      // the last one
        float bottom = 0.0f, bottom_at = 0.0f;  // since then
        float t = step;
        while (t < std::min(length, kMaxLength * scale_)) {
            const float now = clearance(t);
            if (!is_falling) {
                is_falling = now < peak;
                if (!is_falling) peak = now;
                bottom = now;
                bottom_at = t;
            } else if (now < bottom) {
                bottom = now;
                bottom_at = t;
            } else if (now > std::max(bottom + step, kMinWidening * bottom)) {
                if (bottom < narrowest && peak > kMinWidening * bottom) {
                    narrowest = bottom;
                    at = bottom_at;
                }
                is_falling = false;
                peak = now;
            }
            if (at > 0.0f && now >= reach) break;
            // Nothing is nearer than this: clearance falls by at most the distance moved.
            t += std::max(step, now - narrowest);
        }
        if (at > 0.0f) narrow_.push_back({ray.origin + at * ray.direction, ray.direction});
    }

    /// Fits holes to each group of near places, the largest first.
    std::vector<Opening> cluster() {
        std::vector<Opening> openings;
        std::vector<bool> is_taken(narrow_.size());
        while (openings.size() < kMaxOpenings) {
            const std::vector<size_t> group = largest_group(is_taken);
            if (group.size() < kMinPoints) break;
            std::vector<NarrowPlace> places;
            for (const size_t i : group) {
                is_taken[i] = true;
                places.push_back(narrow_[i]);
            }
            const float max_area = kMaxArea * scale_ * scale_;
            std::ranges::copy_if(fit_holes(trace_scene_, places, scale_),
                                 std::back_inserter(openings),
                                 [&](const Opening& hole) { return hole.area() < max_area; });
        }
        return openings;
    }

    /// The largest group of places that short distances connect.
    [[nodiscard]] std::vector<size_t> largest_group(const std::vector<bool>& is_taken) const {
        std::vector<size_t> best;
        std::vector<bool> is_seen = is_taken;
        const float link = kLink * scale_;
        for (size_t seed = 0; seed < narrow_.size(); ++seed) {
            if (is_seen[seed]) continue;
            std::vector<size_t> group{seed};
            is_seen[seed] = true;
            for (size_t k = 0; k < group.size(); ++k) {
                for (size_t i = 0; i < narrow_.size(); ++i) {
                    if (is_seen[i]) continue;
                    if (glm::distance(narrow_[i].position, narrow_[group[k]].position) > link)
                        continue;
                    is_seen[i] = true;
                    group.push_back(i);
                }
            }
            if (group.size() > best.size()) best = std::move(group);
        }
        return best;
    }

    const TraceScene& trace_scene_;
    std::vector<Triangle> triangles_;
    float scale_ = 1.0f;  ///< metres a unit of the constants
    std::vector<Place> enclosed_;
    std::vector<NarrowPlace> narrow_;
};

}  // namespace

std::vector<Opening> find_openings(const TraceScene& trace_scene) {
    return Finder(trace_scene).find();
}

}  // namespace tetralight
