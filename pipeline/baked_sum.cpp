// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/baked_sum.h>

#include <vector>

#include <tetralight/probes/recombine.h>

namespace tetralight {

Result<BakedSum> BakedSum::make(const ProbeVolumeView& volume) {
    BakedSum sum;
    sum.view_ = volume;
    const std::vector<float> ones(volume.layers.size(), 1.0f);
    if (layer_weights(volume) == ones) return sum;
    sum.copy_ = copy_volume(volume);
    if (auto status = recombine(*sum.copy_, ones); !status) return status.error();
    return sum;
}

}  // namespace tetralight
