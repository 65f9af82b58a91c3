// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/filter_texels.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include <tetralight/bake/lightmap/chart_means.h>
#include <tetralight/bake/lightmap/pooled_variance.h>
#include <tetralight/bake/parallel.h>

namespace tetralight {
namespace {

/// Smaller weights are 0.
constexpr float kLeastWeight = 0.05f;

double square_of_light(const NoisyTexel& texel) {
    const glm::dvec3 light = 0.5 * (glm::dvec3(texel.halves[0]) + glm::dvec3(texel.halves[1]));
    return glm::dot(light, light);
}

/// Variances of halves, by the samples of the texels around too.
std::vector<float> pooled_variances(const PageCharts& pages, std::span<const NoisyTexel> texels,
                                    int radius, uint32_t thread_count) {
    // Of one sample, times the samples, so that all samples count alike.
    std::vector<double> variances, squares, counts;
    for (const NoisyTexel& texel : texels) {
        const auto count = double{texel.sample_count};
        variances.push_back(double{texel.variance} * count * count);
        squares.push_back(square_of_light(texel) * count);
        counts.push_back(count);
    }
    variances = chart_means(pages, variances, radius, thread_count);
    squares = chart_means(pages, squares, radius, thread_count);
    counts = chart_means(pages, counts, radius, thread_count);
    std::vector<float> pooled;
    for (size_t i = 0; i < texels.size(); ++i) {
        const auto count = double{texels[i].sample_count};
        const double around = variances[i] / (counts[i] * count);
        pooled.push_back(static_cast<float>(pooled_variance(double{texels[i].variance}, around,
                                                            square_of_light(texels[i]),
                                                            squares[i] / counts[i])));
    }
    return pooled;
}

/// Filters one tile.
class TileFilter {
  public:
    TileFilter(const PageCharts& pages, std::span<const NoisyTexel> texels,
               std::span<const float> variances, const TexelFilterSettings& settings,
               const PageCharts::Tile& tile)
        : texels_(texels),
          settings_(settings),
          inner_(tile.high - tile.low),
          margin_(settings.radius + settings.patch_radius),
          size_(inner_ + 2 * margin_),
          least_cosine_(std::cos(glm::radians(settings.max_angle_degrees))) {
        indices_.resize(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y));
        pages.copy_texels(tile.chart, tile.low - margin_, size_, indices_);
        for (int y = 0; y < inner_.y; ++y) {
            for (int x = 0; x < inner_.x; ++x)
                own_.push_back(pages.texel_of(tile.chart, tile.low + glm::ivec2(x, y)));
        }
        for (const uint32_t index : indices_) {
            noisy_.push_back(index == kNoIndex ? NoisyTexel{} : texels[index]);
            if (index != kNoIndex) noisy_.back().variance = variances[index];
        }
    }

    void run(const std::function<void(uint32_t, std::span<const TexelShare>)>& use) {
        shares_.resize(static_cast<size_t>(inner_.x) * static_cast<size_t>(inner_.y));
        for (int dy = -settings_.radius; dy <= settings_.radius; ++dy) {
            for (int dx = -settings_.radius; dx <= settings_.radius; ++dx) add_offset({dx, dy});
        }
        for (int y = 0; y < inner_.y; ++y) {
            for (int x = 0; x < inner_.x; ++x) {
                std::vector<TexelShare>& shares = shares_[static_cast<size_t>(y * inner_.x + x)];
                if (shares.empty()) continue;
                normalize(shares);
                use(indices_[index_of({x + margin_, y + margin_})], shares);
            }
        }
    }

  private:
    /// Squares of the differences of both halves beyond what noise explains.
    using Difference = std::array<float, 2>;

    [[nodiscard]] size_t index_of(glm::ivec2 place) const {
        return static_cast<size_t>(place.y * size_.x + place.x);
    }

    [[nodiscard]] Difference difference(const NoisyTexel& a, const NoisyTexel& b) const {
        constexpr float kLeastVariance = 1e-20f;
        const float noise = a.variance + std::min(a.variance, b.variance);
        const float scale = 1.0f / (kLeastVariance + settings_.strength * settings_.strength *
                                                         (a.variance + b.variance));
        Difference result{};
        for (size_t half = 0; half < 2; ++half) {
            const glm::vec3 offset = a.halves[half] - b.halves[half];
            result[half] = (glm::dot(offset, offset) - noise) * scale;
        }
        return result;
    }

    /// Adds the texels at an offset to the shares of all texels of the tile.
    void add_offset(glm::ivec2 offset) {
        if (offset == glm::ivec2(0)) {
            for_each_own([&](glm::ivec2 place, std::vector<TexelShare>& shares) {
                const uint32_t own = indices_[index_of(place)];
                const float count = texels_[own].sample_count;
                shares.push_back({own, {count, count}});
            });
            return;
        }
        compare(offset);
        for_each_own([&](glm::ivec2 place, std::vector<TexelShare>& shares) {
            const uint32_t own = indices_[index_of(place)];
            const uint32_t other = indices_[index_of(place + offset)];
            if (other == kNoIndex ||
                glm::dot(texels_[own].normal, texels_[other].normal) < least_cosine_)
                return;
            TexelShare share{other, {}};
            const Difference mean = mean_difference(place);
            // Each half takes the weight of the other.
            for (size_t half = 0; half < 2; ++half) {
                const float weight = std::exp(-std::max(0.0f, mean[half]));
                share.halves[1 - half] =
                    weight < kLeastWeight ? 0.0f : weight * texels_[other].sample_count;
            }
            if (share.halves[0] > 0.0f || share.halves[1] > 0.0f) shares.push_back(share);
        });
    }

    template <class Visit>
    void for_each_own(const Visit& visit) {
        for (int y = 0; y < inner_.y; ++y) {
            for (int x = 0; x < inner_.x; ++x) {
                const auto inner = static_cast<size_t>(y * inner_.x + x);
                if (own_[inner] == kNoIndex) continue;
                visit(glm::ivec2(x, y) + margin_, shares_[inner]);
            }
        }
    }

    /// Sums of differences over rows of patches, for all texels that patches of the tile reach.
    void compare(glm::ivec2 offset) {
        const int patch = settings_.patch_radius;
        rows_.assign(indices_.size(), {});
        const int low_x = margin_ - patch, high_x = margin_ + inner_.x + patch;
        std::vector<PatchSum> line(static_cast<size_t>(size_.x));
        for (int y = margin_ - patch; y < margin_ + inner_.y + patch; ++y) {
            for (int x = low_x; x < high_x; ++x) {
                PatchSum& sum = line[static_cast<size_t>(x)];
                sum = {};
                const size_t a = index_of({x, y}), b = index_of(glm::ivec2(x, y) + offset);
                if (indices_[a] == kNoIndex || indices_[b] == kNoIndex) continue;
                sum.difference = difference(noisy_[a], noisy_[b]);
                sum.count = 1.0f;
            }
            for (int x = margin_; x < margin_ + inner_.x; ++x) {
                PatchSum& sum = rows_[index_of({x, y})];
                for (int i = -patch; i <= patch; ++i) sum += line[static_cast<size_t>(x + i)];
            }
        }
    }

    [[nodiscard]] Difference mean_difference(glm::ivec2 place) const {
        PatchSum sum;
        for (int i = -settings_.patch_radius; i <= settings_.patch_radius; ++i)
            sum += rows_[index_of({place.x, place.y + i})];
        return {sum.difference[0] / sum.count, sum.difference[1] / sum.count};
    }

    static void normalize(std::vector<TexelShare>& shares) {
        for (size_t half = 0; half < 2; ++half) {
            float sum = 0.0f;
            for (const TexelShare& share : shares) sum += share.halves[half];
            for (TexelShare& share : shares) share.halves[half] /= sum;
        }
    }

    struct PatchSum {
        Difference difference{};
        float count = 0.0f;

        PatchSum& operator+=(const PatchSum& other) {
            difference[0] += other.difference[0];
            difference[1] += other.difference[1];
            count += other.count;
            return *this;
        }
    };

    std::span<const NoisyTexel> texels_;
    const TexelFilterSettings& settings_;
    glm::ivec2 inner_;
    int margin_;
    glm::ivec2 size_;  ///< with margins
    float least_cosine_;
    std::vector<uint32_t> indices_;  ///< with margins, across seams
    std::vector<uint32_t> own_;      ///< of the tile
    std::vector<NoisyTexel> noisy_;
    std::vector<PatchSum> rows_;
    std::vector<std::vector<TexelShare>> shares_;
};

}  // namespace

void filter_texels(const PageCharts& pages, std::span<const NoisyTexel> texels,
                   const TexelFilterSettings& settings, uint32_t thread_count,
                   const std::function<void(uint32_t, std::span<const TexelShare>)>& use) {
    const std::vector<float> variances =
        pooled_variances(pages, texels, settings.noise_radius, thread_count);
    const std::vector<PageCharts::Tile> tiles = pages.tiles();
    parallel_for(tiles.size(), thread_count, [&](size_t i) {
        TileFilter(pages, texels, variances, settings, tiles[i]).run(use);
    });
}

}  // namespace tetralight
