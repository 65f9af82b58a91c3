// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bench/beast_baseline.h>
#include <tetralight/probes/probe_volume.h>

// Handlers that answer queries as a plain Beast server would, with the batch of the library. They
// check nothing.

namespace tetralight::bench {

/// Binary queries in floats (`server::QueryHeader`).
[[nodiscard]] PlainHandler answers_binary(const ProbeVolumeView& volume);

/// Queries in JSON, read and written by nlohmann-json.
[[nodiscard]] PlainHandler answers_json(const ProbeVolumeView& volume);

}  // namespace tetralight::bench
