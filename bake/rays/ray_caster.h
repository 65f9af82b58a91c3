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
    /// Need not be a unit vector; distances are in units of its length.
    glm::vec3 direction{0.0f};
    float max_distance = std::numeric_limits<float>::infinity();
};

struct RayHit {
    float distance = 0.0f;
    uint32_t geometry = 0;   ///< number that `add_*` returned
    uint32_t primitive = 0;  ///< triangle or sphere of that geometry
    /// Weights of a triangle's second and third corner.
    glm::vec2 barycentric{0.0f};
    /// Not normalized; on the side from which the triangle is counter-clockwise.
    glm::vec3 normal{0.0f};
};

/// Says whether a ray stops at a hit. Called for filtered geometries only, from many threads.
struct HitFilter {
    bool (*accepts_hit)(const void* context, const Ray& ray, const RayHit& hit) = nullptr;
    const void* context = nullptr;
};

enum class RayKind : uint8_t { Nearest, Shadow };

/// Is told of every ray and the distance of its hit, from the thread that casts it: how benchmarks
/// record the rays. Infinity: no hit. Shadow rays look for any hit: 0.
struct RayListener {
    void (*on_ray)(void* context, const Ray& ray, RayKind kind, float distance) = nullptr;
    void* context = nullptr;
};

/// Finds what rays hit; the only part that knows Embree. Add geometry, commit once, then cast from
/// any number of threads. Same answers for any number of threads on one instruction set.
class RayCaster {
  public:
    explicit RayCaster(HitFilter filter = {});
    ~RayCaster();
    RayCaster(RayCaster&&) noexcept;
    RayCaster& operator=(RayCaster&&) noexcept;

    enum class Filtered : bool { No, Yes };

    /// Adds triangles and returns their number, counted from 0. Data is copied.
    uint32_t add_triangles(std::span<const glm::vec3> positions, std::span<const uint32_t> indices,
                           Filtered filtered = Filtered::No);

    /// Adds spheres given as (center, radius) and returns their number.
    uint32_t add_spheres(std::span<const glm::vec4> spheres);

    /// Builds the search structure. Error: not enough memory.
    [[nodiscard]] Status commit();

    /// Default: none. Not while rays are cast.
    void listen(RayListener listener);

    [[nodiscard]] std::optional<RayHit> intersect(const Ray& ray) const;
    [[nodiscard]] bool occluded(const Ray& ray) const;

    /// The point of all triangles that is nearest to a position; filters have no say, and spheres
    /// do not count.
    [[nodiscard]] std::optional<glm::vec3> nearest_point(glm::vec3 position) const;

  private:
    struct Handles;
    std::unique_ptr<Handles> handles_;
};

}  // namespace tetralight
