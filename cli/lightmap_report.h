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

/// Standard errors of texels; 0: not known.
struct TexelErrors {
    float median = 0.0f;
    float worst = 0.0f;
};

[[nodiscard]] TexelErrors errors_of(const LightmapReport& report);

/// Null if they are not known.
[[nodiscard]] Json to_json(const TexelErrors& errors);

/// As one line for people.
[[nodiscard]] std::string to_text(const TexelErrors& errors);

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
