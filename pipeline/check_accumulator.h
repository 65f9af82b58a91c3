// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/bake/round_plan.h>

namespace tetralight {

/// True if the accumulator can be the result of rounds of this plan: for bytes from files.
[[nodiscard]] bool is_possible(const ProbeAccumulator& accumulator, const RoundPlan& plan);

}  // namespace tetralight
