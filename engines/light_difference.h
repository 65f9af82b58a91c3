// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include <tetralight/base/box.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/receiver.h>

// How far the light that an engine shows is from the volume's.

namespace tetralight {

/// Of the differences at many places: the largest of all channels and of 14 normals, ÷ the largest
/// irradiance of any probe at these normals.
struct DifferenceQuantiles {
    double median = 0.0;
    double p99 = 0.0;
    double p999 = 0.0;
    double worst = 0.0;

    bool operator==(const DifferenceQuantiles&) const = default;
};

struct LightDifference {
    uint32_t place_count = 0;
    /// From what `interpolate` answers.
    DifferenceQuantiles from_light;
    /// From what it answers if no wall hides a probe: the difference of the interpolation alone.
    DifferenceQuantiles without_walls;

    bool operator==(const LightDifference&) const = default;
};

/// What an engine shows at a world position.
using LightAt = std::function<IrradianceSh(const glm::dvec3& position)>;

/// Irradiance of a surface with a unit normal.
using IrradianceByNormal = std::function<glm::vec3(const glm::vec3& normal)>;

/// What an engine shows at a world position, if it shows something other than SH.
using IrradianceAt = std::function<IrradianceByNormal(const glm::dvec3& position)>;

/// World positions that are evenly random in the inner cells of a volume, and in the box if there
/// is one: the same ones in each call. Fewer than `count`, or none, if few or no cells are in the
/// box.
[[nodiscard]] std::vector<glm::dvec3> random_places(
    const ProbeVolumeView& volume, uint32_t count,
    const std::optional<Box<glm::dvec3>>& box = std::nullopt);

/// The irradiance that the volume has at a world position.
[[nodiscard]] IrradianceSh light_at(const ProbeVolumeView& volume, const glm::dvec3& position,
                                    Walls walls);

/// The largest irradiance of any probe and channel at the 14 normals; 0 without light.
[[nodiscard]] double largest_irradiance(const ProbeVolumeView& volume);

/// Compares at the given places. All quantiles are 0 without places or light.
[[nodiscard]] LightDifference measure_difference(const ProbeVolumeView& volume,
                                                 const std::vector<glm::dvec3>& places,
                                                 const LightAt& shown);
[[nodiscard]] LightDifference measure_difference(const ProbeVolumeView& volume,
                                                 const std::vector<glm::dvec3>& places,
                                                 const IrradianceAt& shown);

/// Places that a difference is measured at.
inline constexpr uint32_t kDifferencePlaces = 10'000;

}  // namespace tetralight
