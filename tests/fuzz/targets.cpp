// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/targets.h"

namespace tetralight::fuzz {

std::span<const Target> targets() {
    static constexpr Target kTargets[] = {{"probes", fuzz_probe_file, replay_probe_file},
                                          {"groups", fuzz_probe_groups, replay_probe_groups}};
    return kTargets;
}

}  // namespace tetralight::fuzz
