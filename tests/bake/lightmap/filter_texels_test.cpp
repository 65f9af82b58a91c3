// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/filter_texels.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>
#include <vector>

namespace tetralight {
namespace {

constexpr int kSize = 80;  // more than two tiles

/// One chart of kSize² texels whose light is noisy.
class NoisyChart : public testing::Test {
  protected:
    NoisyChart() {
        const std::vector<uint32_t> chart(size_t{kSize} * kSize, 0);
        pages.add(0, {0, 0}, kSize, chart);
        for (int i = 0; i < kSize * kSize; ++i)
            pages.set_texel(0, {i % kSize, i / kSize}, static_cast<uint32_t>(i));
    }

    /// `light(x, y)` with this standard error of the mean of both halves.
    template <class Light>
    [[nodiscard]] static std::vector<NoisyTexel> noisy(const Light& light, float error,
                                                       uint32_t seed = 1) {
        std::mt19937 engine(seed);
        std::normal_distribution<float> noise(0.0f, error * std::sqrt(2.0f));
        std::vector<NoisyTexel> texels;
        for (int i = 0; i < kSize * kSize; ++i) {
            NoisyTexel& texel = texels.emplace_back();
            for (glm::vec3& half : texel.halves)
                half = glm::vec3(light(i % kSize, i / kSize) + noise(engine));
            texel.variance = 3.0f * 2.0f * error * error;
            texel.normal = {0, 1, 0};
        }
        return texels;
    }

    /// The filtered mean of both halves of each texel.
    [[nodiscard]] std::vector<double> filtered(const std::vector<NoisyTexel>& texels,
                                               uint32_t threads = 0) const {
        std::vector<double> result(texels.size(), -1.0);
        std::atomic<size_t> count = 0;
        filter_texels(pages, texels, {}, threads,
                      [&](uint32_t texel, std::span<const TexelShare> shares) {
                          double sum = 0.0, weights[2] = {};
                          for (const TexelShare& share : shares) {
                              for (size_t half = 0; half < 2; ++half) {
                                  const auto weight = double{share.halves[half]};
                                  weights[half] += weight;
                                  sum += 0.5 * weight * double{texels[share.texel].halves[half].x};
                              }
                          }
                          EXPECT_NEAR(weights[0], 1.0, 1e-5);
                          EXPECT_NEAR(weights[1], 1.0, 1e-5);
                          result[texel] = sum;
                          ++count;
                      });
        EXPECT_EQ(count, texels.size());
        return result;
    }

    /// Root mean square of the differences to the light.
    template <class Light>
    [[nodiscard]] static double error_of(const std::vector<double>& values, const Light& light) {
        double sum = 0.0;
        for (int i = 0; i < kSize * kSize; ++i) {
            const double truth = double{light(i % kSize, i / kSize)};
            sum += std::pow(values[static_cast<size_t>(i)] - truth, 2);
        }
        return std::sqrt(sum / (kSize * kSize));
    }

    PageCharts pages{kSize, 1};
};

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double raw_mean(const std::vector<NoisyTexel>& texels) {
    double sum = 0.0;
    for (const NoisyTexel& texel : texels)
        sum += 0.5 * double{texel.halves[0].x + texel.halves[1].x};
    return sum / static_cast<double>(texels.size());
}

/// Estimates are 1, or 9 where they hit a small bright spot.
struct RareSpots {
    double probability = 0.05;
    float brightness = 8.0f;

    [[nodiscard]] float light() const {
        return 1.0f + static_cast<float>(probability) * brightness;
    }

    [[nodiscard]] NoisyTexel texel(int count, std::mt19937& engine) const {
        int hits[2] = {};
        std::bernoulli_distribution hit(probability);
        for (int i = 0; i < count; ++i) hits[i % 2] += hit(engine);
        NoisyTexel texel;
        for (size_t half = 0; half < 2; ++half) {
            const float mean = static_cast<float>(hits[half]) / (0.5f * static_cast<float>(count));
            texel.halves[half] = glm::vec3(1.0f + brightness * mean);
        }
        const float all = static_cast<float>(hits[0] + hits[1]) / static_cast<float>(count);
        // Three channels, and half of the estimates.
        texel.variance = 3.0f * brightness * brightness * all * (1.0f - all) /
                         static_cast<float>(count - 1) * 2.0f;
        texel.sample_count = static_cast<float>(count);
        texel.normal = {0, 1, 0};
        return texel;
    }

    /// With `more` estimates after those of `first`.
    [[nodiscard]] NoisyTexel texel(const NoisyTexel& first, int more, std::mt19937& engine) const {
        NoisyTexel all = texel(more, engine);
        const float before = first.sample_count, after = all.sample_count, sum = before + after;
        for (size_t half = 0; half < 2; ++half)
            all.halves[half] = (first.halves[half] * before + all.halves[half] * after) / sum;
        all.variance =
            (first.variance * before * before + all.variance * after * after) / (sum * sum);
        all.sample_count = sum;
        return all;
    }
};

TEST_F(NoisyChart, EvenLightLosesItsNoiseAndKeepsItsMean) {
    const auto even = [](int, int) { return 1.0f; };
    const auto texels = noisy(even, 0.1f);
    const auto result = filtered(texels);
    EXPECT_LT(error_of(result, even), 0.1 / 3.0);  // nine times the samples
    EXPECT_NEAR(mean(result), raw_mean(texels), 0.002);
}

TEST_F(NoisyChart, AnEdgeBeyondTheNoiseStays) {
    const auto edge = [](int x, int) { return x < kSize / 2 ? 1.0f : 3.0f; };
    const auto texels = noisy(edge, 0.1f);
    const auto result = filtered(texels);
    // Texels at both sides of the edge, on average over all rows.
    for (const int x : {kSize / 2 - 1, kSize / 2}) {
        double sum = 0.0;
        for (int y = 0; y < kSize; ++y) sum += result[static_cast<size_t>(y * kSize + x)];
        const double truth = double{edge(x, 0)};
        EXPECT_NEAR(sum / kSize, truth, 0.03 * truth);
    }
    EXPECT_LT(error_of(result, edge), 0.1 / 2.0);
}

TEST_F(NoisyChart, RareBrightSamplesAreSharedNotLost) {
    // One texel of 20 has met a light that all see, in one of its halves.
    std::mt19937 engine(3);
    std::vector<NoisyTexel> texels(size_t{kSize} * kSize);
    for (NoisyTexel& texel : texels) {
        texel.normal = {0, 1, 0};
        for (glm::vec3& half : texel.halves) {
            const bool has_met = engine() % 40 == 0;
            half = glm::vec3(has_met ? 41.0f : 1.0f);
            if (has_met) texel.variance += 3.0f * 40.0f * 40.0f;
        }
        texel.variance = std::max(texel.variance, 1e-4f);
    }
    EXPECT_NEAR(mean(filtered(texels)), raw_mean(texels), 0.01 * raw_mean(texels));
}

TEST_F(NoisyChart, TexelsThatMissedRareSamplesAreFilteredToo) {
    const RareSpots spots;
    std::mt19937 engine(7);
    std::vector<NoisyTexel> texels;
    double raw = 0.0;
    const auto even = [&](int, int) { return spots.light(); };
    for (int i = 0; i < kSize * kSize; ++i) {
        // Two texels of three miss all spots: they do not know their variance.
        texels.push_back(spots.texel(8, engine));
        const auto mean = 0.5 * double{texels.back().halves[0].x + texels.back().halves[1].x};
        raw += std::pow(mean - double{spots.light()}, 2) / (kSize * kSize);
    }
    const auto result = filtered(texels);
    EXPECT_LT(error_of(result, even), std::sqrt(raw) / 4.0);  // sixteen times the samples
    EXPECT_NEAR(mean(result), raw_mean(texels), 0.005 * raw_mean(texels));
}

TEST_F(NoisyChart, TexelsThatEndEarlyDoNotDarkenOthers) {
    // As a target error does: texels that miss all spots look exact and end.
    const RareSpots spots;
    std::mt19937 engine(8);
    std::vector<NoisyTexel> texels;
    for (int i = 0; i < kSize * kSize; ++i) {
        const NoisyTexel first = spots.texel(8, engine);
        texels.push_back(first.variance > 0.0f ? spots.texel(first, 64, engine) : first);
    }
    EXPECT_LT(raw_mean(texels), 0.95 * double{spots.light()});
    EXPECT_NEAR(mean(filtered(texels)), double{spots.light()}, 0.015 * double{spots.light()});
}

TEST_F(NoisyChart, DarkTexelsBesideBrightOnesStayDark) {
    // A line of a single texel, which takes no part in the noise around it.
    const auto line = [](int x, int) { return x == kSize / 2 ? 0.3f : 2.0f; };
    auto texels = noisy(line, 0.4f);
    for (int y = 0; y < kSize; ++y) {
        NoisyTexel& texel = texels[static_cast<size_t>(y * kSize + kSize / 2)];
        const float sign = y % 2 == 0 ? 1.0f : -1.0f;
        texel.halves = {glm::vec3(0.3f + 0.01f * sign), glm::vec3(0.3f - 0.01f * sign)};
        texel.variance = 3.0f * 2.0f * 0.01f * 0.01f;
    }
    const auto result = filtered(texels);
    double sum = 0.0;
    for (int y = 0; y < kSize; ++y) sum += result[static_cast<size_t>(y * kSize + kSize / 2)];
    EXPECT_NEAR(sum / kSize, 0.3, 0.03 * 0.3);
}

TEST_F(NoisyChart, LightWithoutNoiseStaysAsItIs) {
    const auto slope = [](int x, int y) { return 1.0f + 0.01f * static_cast<float>(x + 2 * y); };
    const auto result = filtered(noisy(slope, 0.0f));
    EXPECT_LT(error_of(result, slope), 1e-6);
}

TEST_F(NoisyChart, OtherNormalsAreNotMixed) {
    const auto two = [](int x, int) { return x % 2 == 0 ? 1.0f : 1.05f; };
    auto texels = noisy(two, 0.1f);
    for (size_t i = 1; i < texels.size(); i += 2)  // kSize is even: columns
        texels[i].normal = glm::vec3(std::sqrt(0.5f), std::sqrt(0.5f), 0);
    const auto result = filtered(texels);
    double even = 0.0, odd = 0.0;
    for (size_t i = 0; i < result.size(); i += 2) {
        even += result[i] / (kSize * kSize / 2.0);
        odd += result[i + 1] / (kSize * kSize / 2.0);
    }
    EXPECT_NEAR(even, 1.0, 0.005);
    EXPECT_NEAR(odd, 1.05, 0.005);
}

TEST_F(NoisyChart, TheSameForAnyNumberOfThreads) {
    const auto texels =
        noisy([](int x, int) { return 1.0f + 0.02f * static_cast<float>(x); }, 0.2f);
    EXPECT_EQ(filtered(texels, 1), filtered(texels, 3));
}

}  // namespace
}  // namespace tetralight
