// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight {

/// How a volume was baked, as JSON: the program's version, hashes of what the bake reads of the
/// scene and of its adjustment volumes, and the settings. A setting is left out if it has its
/// default value and earlier versions of the program left it out.
///
/// `has_dering`: true if the ringing of at least one group is removed.
[[nodiscard]] std::string bake_metadata(const Scene& scene, const BakeVolumeSettings& settings,
                                        bool has_overrides, bool has_dering);

}  // namespace tetralight
