// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/targets.h"

namespace tetralight::fuzz {

std::span<const Target> targets() {
    static constexpr Target kTargets[] = {{"probes", fuzz_probe_file, replay_probe_file},
                                          {"groups", fuzz_probe_groups, replay_probe_groups},
                                          {"imports", fuzz_imports, replay_import},
                                          {"images", fuzz_images, replay_image},
                                          {"hdr", fuzz_hdr, replay_image},
                                          {"gltf", fuzz_gltf, replay_gltf}};
    return kTargets;
}

}  // namespace tetralight::fuzz
