// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::conformance {

/// A volume of the conformance vectors (docs/how_to_query.md).
struct VectorVolume {
    std::string name;
    std::string about;
    ProbeVolume volume;
};

/// All of them: small, and the same in each call. Each passes `verify`.
[[nodiscard]] std::vector<VectorVolume> make_vector_volumes();

/// The largest |coefficient| of the light of probes, layers and ambient light: the unit of
/// tolerances.
[[nodiscard]] float largest_light(const ProbeVolumeView& volume);

}  // namespace tetralight::conformance
