// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
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
    [[nodiscard]] size_t index(uint32_t baked) const { return baked * size_t{value_count_}; }

    void filter(const PreparedLightmaps& prepared, const TexelBake& bake);

    size_t value_count_ = 0;  ///< of a texel: the total and the layers
    std::vector<TexelLight> lights_;
};

}  // namespace tetralight
