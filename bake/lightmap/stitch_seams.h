// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <tetralight/bake/lightmap/seams.h>

namespace tetralight {

/// Changes texels beside seams so that bilinear samples of both sides agree: the least squares of
/// differences at places along the seams, and of changes of texels (Rakhteenko 2018, "Baking
/// Artifact-Free Lightmaps on the GPU", section "Seams").
///
///     Σ_places l (A x)² + Σ_texels w (x − x_0)²
///
/// A row of A has the weights of the four texels on each side of a place, which stands for l half
/// texels of the seam. The solution is a linear function of x_0, so that the light of layers still
/// adds up.
class SeamStitcher {
  public:
    /// `weight`: w of a texel by its index in the pages (page · size² + row · size + column), above
    /// 0.
    SeamStitcher(std::span<const Seam> seams, uint32_t page_size,
                 const std::function<double(uint64_t)>& weight);
    ~SeamStitcher();

    /// Indices of the texels that may change, in ascending order.
    [[nodiscard]] const std::vector<uint64_t>& texels() const { return texels_; }

    /// Number of places at which both sides are compared.
    [[nodiscard]] size_t place_count() const { return row_begins_.size() - 1; }

    /// Differences between both sides at the places. `values`: one a texel.
    [[nodiscard]] std::vector<double> differences(std::span<const double> values) const;

    /// The relative difference of both sides that a fraction of the length of all seams does not
    /// exceed: the difference over the mean of both, or over a hundredth of the mean light of all
    /// seams where that is more. 0 without light.
    [[nodiscard]] double relative_percentile(std::span<const double> values, double fraction) const;

    /// Holds texels at 0 from now on, so that none of these values becomes negative: between bright
    /// and dark sides least squares would go below 0.
    void hold_zeros(std::span<const double> values);

    /// The stitched values of the texels. Thread-safe.
    [[nodiscard]] std::vector<double> stitched(std::span<const double> values) const;

  private:
    struct Equations;

    struct Entry {
        uint32_t texel = 0;  ///< index into `texels_`
        float factor = 0.0f;
    };

    void add_seam(const Seam& seam, uint32_t page_size, std::vector<uint64_t>& all);
    void factor();

    std::vector<uint64_t> texels_;
    std::vector<double> weights_;
    std::vector<bool> is_zero_;  ///< texels that are held at 0
    std::vector<size_t> row_begins_{0};
    std::vector<Entry> entries_;
    std::vector<float> lengths_;  ///< l of each place
    std::unique_ptr<Equations> equations_;
};

}  // namespace tetralight
