// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/probes/probe_volume.h>
#include "tests/conformance/numbers.h"
#include "tests/conformance/vector_answer.h"

namespace tetralight::conformance {

/// Positions of every kind: at probes, on edges and faces, inside, outside near and far, beyond the
/// distance to which positions count, and not finite. Some may be doubtful for one or the other
/// reader.
[[nodiscard]] std::vector<VectorPosition> make_vector_positions(const ProbeVolumeView& volume,
                                                                Numbers& numbers);

/// Positions inside whose light walls change.
[[nodiscard]] std::vector<VectorPosition> make_hidden_positions(const ProbeVolumeView& volume,
                                                                size_t count, Numbers& numbers);

/// Positions outside the hull, up to a few times its size.
[[nodiscard]] std::vector<VectorPosition> make_outside_positions(const ProbeVolumeView& volume,
                                                                 size_t count, Numbers& numbers);

}  // namespace tetralight::conformance
