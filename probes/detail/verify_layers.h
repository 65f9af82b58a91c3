// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// Checks the sections of mixed lighting, layers and transfer as docs/file_format.md specifies
/// them. Returns corrupt; the field is the section or its element.
[[nodiscard]] Status check_layers(const ProbeVolumeView& volume);

}  // namespace tetralight::detail
