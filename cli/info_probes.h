// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/cli/common.h>
#include <tetralight/probes/probe_volume.h>

// The health of every probe: what `info --probes` shows.

namespace tetralight::cli {

/// Probes that lie in geometry and are not in the volume.
[[nodiscard]] size_t left_out_count(const ProbeVolumeView& volume);

/// {"probe_list": one object a probe, "left_out_list": group and index of those not there}.
[[nodiscard]] Json probes_json(const ProbeVolumeView& volume);

/// The same as aligned lines under a line of titles, one a probe, without a line break at the end.
[[nodiscard]] std::string probes_text(const ProbeVolumeView& volume);

}  // namespace tetralight::cli
