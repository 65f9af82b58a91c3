// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/baked_sum.h>

#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/recombine.h>

namespace tetralight {

namespace {

std::vector<IrradianceSh> floats_of_halves(const ProbeVolumeView& volume) {
    std::vector<IrradianceSh> irradiance;
    irradiance.reserve(volume.compact.size());
    for (const CompactProbe& probe : volume.compact)
        irradiance.push_back(compact_irradiance(probe, volume.info.compact_scale));
    return irradiance;
}

}  // namespace

Result<BakedSum> BakedSum::make(const ProbeVolumeView& volume) {
    BakedSum sum;
    sum.view_ = volume;
    const std::vector<float> ones(volume.layers.size(), 1.0f);
    const bool has_other_weights = layer_weights(volume) != ones;
    const bool is_in_halves = volume.irradiance.empty() && !volume.compact.empty();
    if (!has_other_weights && !is_in_halves) return sum;
    if (is_in_halves && volume.compact.size() != volume.positions.size()) {
        return Error{ErrorCode::Corrupt, "volume", "",
                     str_cat("the volume holds light of ", volume.compact.size(), " probes, but ",
                             volume.positions.size(), " probes")};
    }
    sum.copy_ = copy_volume(volume);
    if (is_in_halves) sum.copy_->irradiance = floats_of_halves(volume);
    if (!has_other_weights) return sum;
    if (auto status = recombine(*sum.copy_, ones); !status) return status.error();
    return sum;
}

}  // namespace tetralight
