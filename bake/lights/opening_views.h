// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/lights/openings.h>
#include <tetralight/bake/rays/trace_scene.h>

namespace tetralight {

/// Which openings and spots can be seen from cubes of space. A cube is looked at when it is first
/// asked for. Thread-safe.
class OpeningViews {
  public:
    /// Square roots of the fractions of rays that reach an opening or a spot from a cube.
    struct View {
        std::array<float, Openings::kMaxCount> openings{};
        std::array<float, Openings::kMaxCount> spots{};
    };

    /// Keeps references. Precondition: there is an opening.
    OpeningViews(const TraceScene& trace_scene, std::span<const Opening> openings,
                 std::span<const LitSpot> spots, std::span<const Light> lights);
    ~OpeningViews();
    OpeningViews(const OpeningViews&) = delete;
    OpeningViews& operator=(const OpeningViews&) = delete;

    /// The view of the cube around a shading point: for a point on a surface, of the cube that is
    /// half an edge above it.
    [[nodiscard]] const View& view_from(const ShadingPoint& shading_point) const;

  private:
    /// A hash table with a list a bucket. Entries are added at the front of a list and stay until
    /// the end, so that readers need no lock.
    struct Entry {
        glm::ivec3 cube;
        View view;
        const Entry* next = nullptr;
    };

    [[nodiscard]] View look_from(const glm::ivec3& cube) const;
    [[nodiscard]] bool sees_opening(const Opening& opening, glm::vec3 from, glm::vec2 u) const;
    [[nodiscard]] bool sees_spot(const LitSpot& spot, glm::vec3 from, glm::vec2 u,
                                 glm::vec2 light_u) const;

    const TraceScene& trace_scene_;
    std::span<const Opening> openings_;
    std::span<const LitSpot> spots_;
    std::span<const Light> lights_;
    float cube_size_ = 0.0f;
    mutable std::vector<std::atomic<const Entry*>> buckets_;
};

}  // namespace tetralight
