// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight {

/// How a volume was baked, as JSON: the program's version, hashes of what the bake reads of the
/// scene and of its adjustment volumes, and the settings. A setting is left out if it has its
/// default value and earlier versions of the program left it out.
///
/// `has_dering`: true if the ringing of at least one group is removed.
[[nodiscard]] std::string bake_metadata(const Scene& scene, const BakeVolumeSettings& settings,
                                        bool has_overrides, bool has_dering);

/// The settings that metadata records; others, and all of empty metadata, have their defaults.
/// Returns corrupt if the metadata is no JSON object, and corrupt with the setting as field if a
/// member is of another type.
[[nodiscard]] Result<BakeVolumeSettings> recorded_settings(std::string_view metadata);

/// True if metadata records that the light was changed after the bake, other than by the weights of
/// layers.
[[nodiscard]] bool was_relit(std::string_view metadata);

/// True if metadata records another scene than this one, as far as a bake depends on it.
[[nodiscard]] bool is_of_another_scene(std::string_view metadata, const Scene& scene);

}  // namespace tetralight
