// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// What docs/file_format.md says of the sections of mixed lighting, layers and transfer. Errors
/// name the section.
[[nodiscard]] Status check_layers(const ProbeVolumeView& volume);

}  // namespace tetralight::detail
