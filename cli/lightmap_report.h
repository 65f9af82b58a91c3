// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/cli/common.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/pipeline/bake_lightmaps.h>

// What `lightmap` and `merge` report of baked lightmaps.

namespace tetralight::cli {

/// Rays, errors and times, as fields of a bake's JSON.
[[nodiscard]] Json light_json(const LightmapReport& report);

/// Times and rays as one line for people.
[[nodiscard]] std::string times_text(const LightmapReport& report);

/// Standard errors as one line for people.
[[nodiscard]] std::string errors_text(const LightmapReport& report);

/// Pages, charts, texels and seams, as fields of a bake's JSON.
[[nodiscard]] Json pages_json(const LightmapsView& maps, const LightmapReport& report);

/// Pages, charts and texels as one line for people.
[[nodiscard]] std::string pages_line(const LightmapsView& maps, const LightmapReport& report);

/// Seams as one line for people.
[[nodiscard]] std::string seams_text(const LightmapReport& report);

/// Reports a bake of all texels.
void report_lightmaps(const CommonOptions& common, const std::string& output,
                      const LightmapsView& maps, const LightmapReport& report);

}  // namespace tetralight::cli
