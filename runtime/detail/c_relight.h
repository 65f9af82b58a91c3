// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/probes/probe_volume.h>
#include <tetralight/runtime/detail/c_errors.h>

namespace tetralight::detail {

/// The layers that follow distant light.
enum class DistantLayer : uint8_t { Sky, Sun };

/// Returns TETRALIGHT_NOT_THERE if the volume lacks what it takes to relight this layer.
[[nodiscard]] CallError check_relight(const ProbeVolumeView& volume, DistantLayer layer);

}  // namespace tetralight::detail
