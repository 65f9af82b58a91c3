// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// Checks that section "info" has numbers of the right meaning: positions within
/// `kFarthestPosition`, a unit axis where one is needed, the extent of the probes, a cube that
/// can order seeds. Returns corrupt. Precondition: the positions are finite.
[[nodiscard]] Status check_info(const ProbeVolumeView& volume);

/// Checks the members of each light that its type uses: unit directions, sizes and intensities of 0
/// or more, a cone that narrows inwards. Returns corrupt with the member as field.
[[nodiscard]] Status check_light_numbers(const ProbeVolumeView& volume);

}  // namespace tetralight::detail
