// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/estimate_bytes.h>

#include <vector>

#include <tetralight/bake/light_plan.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/pipeline/finish_bake.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight {

uint64_t estimate_bytes(const PreparedBake& prepared) {
    const size_t count = prepared.volume.positions.size();
    const LightGroupLayout layout(prepared.settings.bake.plan);
    const std::vector<ProbeAccumulator> dark(count);
    const std::vector<double> rows(count * layout.size());
    PreparedBake copy = prepared;
    // Nothing is done to light that is not there.
    copy.is_invalid.assign(count, false);
    copy.reused = {};
    return probe_file_bytes(finish_bake(std::move(copy), dark, rows).volume.view()).size();
}

uint64_t estimate_bytes(const PreparedLightmaps& prepared) {
    Lightmaps maps = prepared.lightmaps;
    resize_texels(LightGroupLayout(prepared.settings.bake.plan), maps);
    return lightmap_file_bytes(maps.view()).size();
}

}  // namespace tetralight
