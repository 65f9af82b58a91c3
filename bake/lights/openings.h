// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include <tetralight/bake/lights/light_tree.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/probes/light.h>

namespace tetralight {

class OpeningViews;

/// A rectangle through which light enters a dark part of the scene: a window, a door, an arch.
struct Opening {
    glm::vec3 corner{0.0f};
    glm::vec3 along{0.0f}, across{0.0f};  ///< edges at the corner, perpendicular to each other
    glm::vec3 normal{0.0f};               ///< unit, towards the dark side

    [[nodiscard]] glm::vec3 point(glm::vec2 u) const noexcept {
        return corner + u.x * along + u.y * across;
    }

    /// Square metres.
    [[nodiscard]] float area() const noexcept;

    bool operator==(const Opening&) const = default;
};

/// Where a directional light falls that enters through an opening.
struct LitSpot {
    uint32_t opening = 0;
    uint32_t light = 0;
    glm::vec3 center{0.0f};
    float radius = 0.0f;
    /// Reflected flux, in any unit.
    float power = 0.0f;
};

/// Samples what openings make bright, for shading points on their dark side: directions through
/// openings, and the spots that directional lights throw through them (a special case of
/// bidirectional path tracing: the second vertex of a path from the light). Both have densities for
/// any direction or point, so that they can be combined with other techniques by multiple
/// importance sampling.
///
/// Whether an opening or a spot is visible is found by rays for cubes of space, when a shading
/// point in a cube first asks. The rays depend on the cube alone, so that the order of calls
/// changes nothing. Thread-safe.
class Openings {
  public:
    /// Further openings and spots are ignored.
    static constexpr uint32_t kMaxCount = 32;

    Openings();
    ~Openings();
    Openings(Openings&&) noexcept;
    Openings& operator=(Openings&&) noexcept;

    /// Finds the spots by rays. `lights`: directional, in render space. Keeps a reference to the
    /// scene.
    Openings(const TraceScene& trace_scene, std::vector<Opening> openings,
             std::vector<Light> lights);

    [[nodiscard]] bool is_empty() const { return openings_.empty(); }

    [[nodiscard]] const std::vector<Opening>& openings() const { return openings_; }

    [[nodiscard]] const std::vector<LitSpot>& spots() const { return spots_; }

    [[nodiscard]] const Light& light(uint32_t index) const { return lights_[index]; }

    /// Unnormalized probabilities of openings and of spots at a shading point.
    struct Weights {
        std::array<float, kMaxCount> openings{};
        std::array<float, kMaxCount> spots{};
        float opening_sum = 0.0f;  ///< 0 = no opening is visible
        float spot_sum = 0.0f;     ///< 0 = no spot is visible
    };

    [[nodiscard]] Weights weights(const ShadingPoint& shading_point) const;

    /// A unit direction from `position` through an opening. Precondition: `opening_sum` > 0.
    [[nodiscard]] glm::vec3 sample_direction(const Weights& weights, glm::vec3 position,
                                             float choice, glm::vec2 u) const noexcept;

    /// Density per steradian of `sample_direction`.
    [[nodiscard]] float direction_pdf(const Weights& weights, glm::vec3 position,
                                      glm::vec3 direction) const noexcept;

    /// Where a ray of light enters.
    struct Entrance {
        uint32_t light = 0;
        glm::vec3 position{0.0f};
    };

    /// A light and a point of an opening, uniform by area. Precondition: `spot_sum` > 0.
    [[nodiscard]] Entrance sample_entrance(const Weights& weights, float choice,
                                           glm::vec2 u) const noexcept;

    /// Density of `sample_entrance` per square metre perpendicular to the light, at a position that
    /// the light reaches from the unit direction `to_light`.
    [[nodiscard]] float entrance_density(const Weights& weights, uint32_t light, glm::vec3 position,
                                         glm::vec3 to_light) const noexcept;

  private:
    void find_spot(uint32_t opening, uint32_t light);

    const TraceScene* trace_scene_ = nullptr;
    std::vector<Opening> openings_;
    std::vector<float> areas_;
    std::vector<Light> lights_;
    std::vector<LitSpot> spots_;
    std::unique_ptr<OpeningViews> views_;
};

}  // namespace tetralight
