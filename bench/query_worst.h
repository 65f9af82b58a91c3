// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bench/harness.h>

namespace tetralight::bench {

/// Cells tested a query in sets of probes with long walks, and batches there.
void report_worst_queries(const Options& options);

}  // namespace tetralight::bench
