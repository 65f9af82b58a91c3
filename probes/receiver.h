// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/rendering_layers.h>

// What is lit, as far as it decides which probes of its cell give it light. Locations hold plain
// barycentric weights; these functions change them.

namespace tetralight {

/// Whether walls of the scene hide probes behind them. A volume that knows no walls gives the same
/// light with both.
enum class Walls : uint8_t { HideProbes, Ignore };

/// What remains of the weight of a probe on none of the object's rendering layers: that of a corner
/// far behind a wall, so that weights are defined where no other probe is near.
inline constexpr float kOtherLayersShare = 1e-4f;

/// An object that probes light.
struct Receiver {
    Walls walls = Walls::HideProbes;
    /// Bit i: the object is on rendering layer i. Probes on none of its layers do not light it, if
    /// its cell has others.
    uint32_t rendering_layers = kAllRenderingLayers;
    /// Light of hidden probes fades over this distance behind the wall that hides them, metres, ≥
    /// 0, so that light does not change at once where an object of this radius passes a wall. 0:
    /// over 3 % of the distance from the probe to the wall.
    float radius = 0.0f;

    bool operator==(const Receiver&) const = default;
};

/// The location with weights that know the walls of the volume and the layers of its probes. Their
/// sum stays. Continuous in the position where the receiver stays the same. Thread-safe.
[[nodiscard]] CellLocation visible_location(const ProbeVolumeView& volume, CellLocation location,
                                            const Receiver& receiver = {}) noexcept;

/// The same for each of many locations, for reports of the weights that light was blended with.
void hide_probes(const ProbeVolumeView& volume, std::span<CellLocation> locations,
                 const Receiver& receiver) noexcept;

/// The mean distance, metres, from a position to the probes of its cell, by the weights of the
/// location: continuous, ≥ 0. Outside the hull of the probes, where `location` has the weights of a
/// place on the hull, it is that of this place.
[[nodiscard]] float mean_probe_distance(const ProbeVolumeView& volume,
                                        const CellLocation& location) noexcept;

/// The share of `mean_probe_distance` by which positions on surfaces are pushed off along their
/// normals: more than the distance over which light fades behind a wall.
inline constexpr float kNormalOffset = 0.1f;

/// A position on a surface moved off along its unit normal, so that a wall takes the light of its
/// own side. Precondition: `location` is that of the position.
[[nodiscard]] glm::vec3 push_off_surface(const ProbeVolumeView& volume, glm::vec3 position,
                                         glm::vec3 normal, const CellLocation& location,
                                         float normal_offset = kNormalOffset) noexcept;

}  // namespace tetralight
