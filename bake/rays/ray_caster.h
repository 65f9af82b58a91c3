// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include <tetralight/base/result.h>

namespace tetralight {

struct Ray {
    glm::vec3 origin{0.0f};
    /// Of any length except 0. Distances along the ray are in units of this length.
    glm::vec3 direction{0.0f};
    float max_distance = std::numeric_limits<float>::infinity();
    float min_distance = 0.0f;  ///< nearer hits do not count
};

struct RayHit {
    float distance = 0.0f;
    uint32_t geometry = 0;   ///< as returned by `add_triangles` or `add_spheres`
    uint32_t primitive = 0;  ///< index of the triangle or sphere in the geometry
    /// Weights of the second and third corner of the triangle.
    glm::vec2 barycentric{0.0f};
    /// Not normalized. Points to the side from which the corners are counter-clockwise.
    glm::vec3 normal{0.0f};
};

/// A callback that returns true to accept a hit, or false to continue the ray behind it. Called for
/// filtered geometries only, from any thread.
struct HitFilter {
    bool (*accepts)(const void* context, const Ray& ray, const RayHit& hit) = nullptr;
    const void* context = nullptr;
};

enum class RayKind : uint8_t { Nearest, Shadow };

/// A callback that receives every ray and the distance of its hit, on the thread that traces it.
/// Benchmarks record rays with it. The distance is infinite if there is no hit, and 0 for the hit
/// of a shadow ray, whose distance is unknown.
struct RayListener {
    void (*on_ray)(void* context, const Ray& ray, RayKind kind, float distance) = nullptr;
    void* context = nullptr;
};

/// Ray queries by Embree, which no other file includes. Add geometry, commit once, then query from
/// any number of threads. The results do not depend on the number of threads; they may differ
/// between instruction sets.
class RayCaster {
  public:
    explicit RayCaster(HitFilter filter = {});
    ~RayCaster();
    RayCaster(RayCaster&&) noexcept;
    RayCaster& operator=(RayCaster&&) noexcept;

    enum class Filtered : bool { No, Yes };

    /// Adds triangles and returns the index of their geometry, counted from 0. Copies the data.
    uint32_t add_triangles(std::span<const glm::vec3> positions, std::span<const uint32_t> indices,
                           Filtered filtered = Filtered::No);

    /// Adds spheres, given as (center, radius), and returns the index of their geometry.
    uint32_t add_spheres(std::span<const glm::vec4> spheres);

    /// Builds the BVH. Returns out_of_resources if memory does not suffice.
    [[nodiscard]] Status commit();

    /// Sets the listener; the default is none. Not thread-safe.
    void listen(RayListener listener);

    [[nodiscard]] std::optional<RayHit> intersect(const Ray& ray) const;
    [[nodiscard]] bool occluded(const Ray& ray) const;

    /// `intersect` without the filter: every surface stops the ray.
    [[nodiscard]] std::optional<RayHit> intersect_unfiltered(const Ray& ray) const;

    /// The point on any triangle that is nearest to a position; none without triangles. Ignores
    /// filters and spheres.
    [[nodiscard]] std::optional<glm::vec3> nearest_point(
        glm::vec3 position, float max_distance = std::numeric_limits<float>::infinity()) const;

  private:
    enum class Filter : bool { Applied, Ignored };

    [[nodiscard]] std::optional<RayHit> intersect(const Ray& ray, Filter filter) const;

    struct Handles;
    std::unique_ptr<Handles> handles_;
};

}  // namespace tetralight
