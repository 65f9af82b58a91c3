// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/lightmap/filter_texels.h>
#include <tetralight/bake/texel_light.h>
#include <tetralight/pipeline/bake_lightmaps.h>

namespace tetralight {

/// The light of all baked texels, in total and by layer, as pages hold it: that of their own
/// samples, or filtered (`filter_texels`); and its error.
///
/// The filtered halves are independent, so that half of their difference has the error of their
/// mean. The variance of a filtered texel is its square, pooled over 5 × 5 texels
/// (`pooled_variance`), and at least what the weights leave of the noise of the texels that it
/// takes. Errors are at most 1, as those of own
/// samples are: of a texel that is almost black nothing else is known. They say nothing about blur.
class TexelLights {
  public:
    /// Precondition: the light is that of all baked texels.
    TexelLights(const PreparedLightmaps& prepared, const TexelBake& bake);

    /// Bytes of memory that a texel takes here, at most.
    [[nodiscard]] static constexpr uint64_t texel_bytes(size_t layer_count, bool is_filtered) {
        // Places and charts in the pages, what the filter compares, variances and differences.
        constexpr uint64_t kFilterBytes =
            2 * sizeof(uint32_t) + sizeof(NoisyTexel) + 7 * sizeof(double);
        return (1 + layer_count) * (sizeof(TexelLight) + (is_filtered ? sizeof(TexelHalves) : 0)) +
               sizeof(float) + (is_filtered ? kFilterBytes : 0);
    }

    [[nodiscard]] const TexelLight& total(uint32_t baked) const { return lights_[index(baked)]; }

    /// Relative standard error of the irradiance (`ProbeAccumulator::standard_error`). 0 if it is
    /// unknown or the texel is black.
    [[nodiscard]] float error(uint32_t baked) const { return errors_[baked]; }

    [[nodiscard]] const std::vector<float>& errors() const { return errors_; }

    /// The last layer can be the light of none of the others, "rest".
    [[nodiscard]] const TexelLight& layer(uint32_t baked, size_t layer) const {
        return lights_[index(baked) + 1 + layer];
    }

  private:
    /// Irradiance on the normals of normal maps. The total is the sum of the layers.
    void map_normals(const TexelBake& bake, uint32_t thread_count);

    /// Of the total of a texel in `lights_`; its layers follow.
    [[nodiscard]] size_t index(size_t baked) const { return baked * value_count_; }

    [[nodiscard]] std::vector<NoisyTexel> noisy_texels(const TexelBake& bake,
                                                       std::span<const TexelHalves> halves) const;

    /// Half of the light of both halves of a filtered texel.
    [[nodiscard]] TexelHalves filtered_halves(std::span<const TexelHalves> halves,
                                              std::span<const TexelShare> shares,
                                              size_t value) const;

    /// `halves`: as `lights_`.
    void filter(const PreparedLightmaps& prepared, const TexelBake& bake,
                std::span<const TexelHalves> halves);

    size_t value_count_ = 0;  ///< of a texel: the total and the layers
    std::vector<TexelLight> lights_;
    std::vector<float> errors_;
};

}  // namespace tetralight
