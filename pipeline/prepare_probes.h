// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/build/merge.h>
#include <tetralight/probes/probe_volume.h>

// Before any light is baked: which probes lie in geometry, and what becomes of them.
//
//     merged → survey, adjustment volumes → in geometry? → find_virtual_offset → out: baked there
//                                            → still in: InvalidProbes

namespace tetralight {

/// What becomes of probes that lie in geometry and have no way out.
enum class InvalidProbes : uint8_t {
    LeaveOut,  ///< the volume does without them; its sources say so
    Dilate,    ///< they stay, and take the light of the healthy probes around them
    Keep,      ///< they stay, mostly dark
};

struct HealthSettings {
    /// A probe lies in geometry when it sees more back faces than this leaves.
    float min_validity = 0.75f;
    /// The farthest that a probe in geometry may gather its light from, as a share of the distance
    /// to its group's nearest other probe. Below one half a probe looks from no place that is
    /// nearer to another one. 0: from its own position only.
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
    /// World positions to gather light at.
    std::vector<glm::dvec3> capture_positions;
    /// Distances and offsets; no errors yet.
    std::vector<ProbeHealth> health;
    /// They look from inside geometry.
    std::vector<bool> is_invalid;
    /// Probes that look from elsewhere, and that were left out.
    size_t moved_count = 0;
    size_t left_out_count = 0;
    /// One line for each group that has probes in geometry without a way out.
    std::vector<std::string> warnings;
};

/// Surveys merged probes in a scene. A pure function; for each probe, of itself and its groups
/// alone. Error: not enough memory.
[[nodiscard]] Result<PreparedProbes> prepare_probes(const Scene& scene, MergedProbes merged,
                                                    const HealthSettings& settings,
                                                    uint32_t thread_count = 0);

}  // namespace tetralight
