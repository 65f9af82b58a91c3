// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "probes/probe_file.h"
#include "runtime/tetralight.h"

/// What the C API's handle holds.
struct tetralight_volume {
    tetralight::ProbeFile file;
};

namespace tetralight::detail {

/// The volume that queries read.
[[nodiscard]] inline const ProbeVolumeView& view_of(const tetralight_volume& volume) {
    return volume.file.view();
}

}  // namespace tetralight::detail
