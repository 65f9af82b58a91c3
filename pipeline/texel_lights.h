// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/texel_light.h>
#include <tetralight/pipeline/bake_lightmaps.h>

namespace tetralight {

/// The light of all baked texels, in total and by layer, as pages hold it: that of their own
/// samples, or filtered (`filter_texels`).
class TexelLights {
  public:
    /// Precondition: the light is that of all baked texels.
    TexelLights(const PreparedLightmaps& prepared, const TexelBake& bake);

    [[nodiscard]] const TexelLight& total(uint32_t baked) const { return lights_[index(baked)]; }

    /// The last layer can be the light of none of the others, "rest".
    [[nodiscard]] const TexelLight& layer(uint32_t baked, size_t layer) const {
        return lights_[index(baked) + 1 + layer];
    }

  private:
    /// Of the total of a texel in `lights_`; its layers follow.
    [[nodiscard]] size_t index(size_t baked) const { return baked * value_count_; }

    /// `halves`: as `lights_`.
    void filter(const PreparedLightmaps& prepared, const TexelBake& bake,
                std::span<const TexelHalves> halves);

    size_t value_count_ = 0;  ///< of a texel: the total and the layers
    std::vector<TexelLight> lights_;
};

}  // namespace tetralight
