// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/lightmap_settings.h>

#include <tetralight/cli/bake_settings.h>
#include <tetralight/pipeline/lightmap_settings.h>

namespace tetralight::cli {

BakeLightmapsSettings lightmap_settings(const Values& values) {
    BakeLightmapsSettings settings;
    for_each_lightmap_setting(settings, [&](const char* name, auto& member, Recorded) {
        read_if_any(values, name, member);
    });
    BakeSettings& bake = settings.bake;
    if (takes_default_target(bake, values)) bake = with_default_texel_target(bake);
    settings.layout.thread_count = settings.texels.thread_count = bake.thread_count;
    return settings;
}

}  // namespace tetralight::cli
