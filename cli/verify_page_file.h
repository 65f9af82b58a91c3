// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/verify/verify_page.h>

namespace tetralight::cli {

/// Writes the page of a report, with a picture of the scene in the light of the volume. The worst
/// places and probes are marked in it. `facts.pictures` is set here.
[[nodiscard]] Status write_verify_page(const std::string& path, const Scene& scene,
                                       const ProbeVolumeView& volume, const VerifyReport& report,
                                       VerifyPageFacts facts, uint32_t thread_count);

}  // namespace tetralight::cli
