// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/probes/build/merge.h>
#include <tetralight/probes/probe_volume.h>

// Before light is baked: finds probes inside geometry, and virtual offsets out of it.
//
//     merged → probe visibility, adjustment volumes → inside? → virtual offset found: baked there
//                                                             → none found: InvalidProbes

namespace tetralight {

/// What to do with probes inside geometry for which no virtual offset is found.
enum class InvalidProbes : uint8_t {
    LeaveOut,  ///< the volume does not have them; its sources say so
    Dilate,    ///< they stay, and get the light of the valid probes around them
    Keep,      ///< they stay as they are, mostly dark
};

struct HealthSettings {
    /// A probe is inside geometry if the fraction of rays that hit no back face is below this.
    float min_validity = 0.75f;
    /// Maximum length of the virtual offset of a probe inside geometry, as a fraction of the
    /// distance to the nearest other probe of its group. Below 0.5 no capture position is nearer
    /// to another probe of the group. 0 = no virtual offsets.
    double virtual_offset = 0.45;
    InvalidProbes invalid = InvalidProbes::LeaveOut;

    bool operator==(const HealthSettings&) const = default;
};

/// "leave-out", "dilate", "keep".
[[nodiscard]] const char* name_of(InvalidProbes policy);

/// Probes ready to be baked. Arrays have one element a probe of `merged`.
struct PreparedProbes {
    /// Without those that were left out.
    MergedProbes merged;
    /// World positions to sample light at: positions plus virtual offsets.
    std::vector<glm::dvec3> capture_positions;
    /// With distances and virtual offsets; standard errors are set by the bake.
    std::vector<ProbeHealth> health;
    /// True if the capture position is inside geometry.
    std::vector<bool> is_invalid;
    /// Probes with a virtual offset, and probes that were left out.
    size_t virtual_offset_count = 0;
    size_t left_out_count = 0;
    /// One line for each group with probes inside geometry and no virtual offset.
    std::vector<std::string> warnings;
};

/// Finds which merged probes are inside geometry, and their virtual offsets. A pure function; the
/// result of a probe depends on the probe and its groups alone. `traced` holds the static geometry
/// of the scene.
[[nodiscard]] PreparedProbes prepare_probes(const Scene& scene, const TraceScene& traced,
                                            MergedProbes merged, const HealthSettings& settings,
                                            uint32_t thread_count = 0);

}  // namespace tetralight
