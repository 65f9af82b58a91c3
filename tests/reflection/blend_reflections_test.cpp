// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/sample_reflections.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <tuple>

#include "tests/reflection/reflection_fixture.h"

namespace tetralight {
namespace {

using test::box_probe;

constexpr size_t kMost = ReflectionBlend::kMaxProbes;

ReflectionsView view_of(const std::vector<ReflectionProbe>& probes) {
    ReflectionsView view;
    view.probes = probes;
    return view;
}

/// The weight of each probe.
std::vector<double> weights_of(const std::vector<ReflectionProbe>& probes,
                               const glm::dvec3& position) {
    const ReflectionBlend blend = blend_reflections(view_of(probes), position);
    std::vector<double> weights(probes.size());
    for (size_t i = 0; i < kMost; ++i) {
        if (blend.weights[i] > 0.0f) weights.at(blend.probes[i]) += blend.weights[i];
    }
    return weights;
}

/// The thousandth by which boxes are taken larger.
constexpr double kReach = 1.001;

TEST(ReflectionInfluence, IsASmoothStepFromTheSideOfTheBox) {
    const ReflectionProbe probe = box_probe({10, 0, 0}, {4, 3, 2}, 1.0f);
    EXPECT_EQ(reflection_influence(probe, {10, 0, 0}), 1.0f);
    EXPECT_EQ(reflection_influence(probe, {14, 3, 2}), 1.0f);  // a corner of the walls
    EXPECT_NEAR(reflection_influence(probe, {10 + 4 * kReach + 0.5, 0, 0}), 0.5f, 1e-6f);
    EXPECT_NEAR(reflection_influence(probe, {10, -3 * kReach - 0.75, 1.5}), 0.15625f,
                1e-6f);  // t = ¼: t² (3 − 2t)
    EXPECT_NEAR(reflection_influence(probe, {10, 3 * kReach + 0.3, 2 * kReach + 0.4}), 0.5f,
                1e-6f);  // 0.5 m from the edge
    EXPECT_EQ(reflection_influence(probe, {10 + 4 * kReach + 1, 0, 0}), 0.0f);
    EXPECT_EQ(reflection_influence(probe, {10, 0, 5}), 0.0f);
}

TEST(ReflectionInfluence, WithoutABlendDistanceIsAllOrNothing) {
    const ReflectionProbe probe = box_probe({0, 0, 0}, {1, 1, 1}, 0.0f);
    EXPECT_EQ(reflection_influence(probe, {0.999, 0, 0}), 1.0f);
    EXPECT_EQ(reflection_influence(probe, {1.0005, 0, 0}), 1.0f);  // a wall, rounded
    EXPECT_EQ(reflection_influence(probe, {1.0011, 0, 0}), 0.0f);
    EXPECT_EQ(reflection_influence(ReflectionProbe{}, {1e9, 0, 0}), 1.0f);
}

TEST(ReflectionInfluence, FollowsTheAxesAndTheCenterOfTheBox) {
    ReflectionProbe probe = box_probe({0, 0, 0}, {4, 1, 1}, 0.0f);
    probe.axes = {glm::vec3(0, 0.6f, 0.8f), glm::vec3(1, 0, 0), glm::vec3(0, 0.8f, -0.6f)};
    probe.box_center = {10, 0, 0};
    EXPECT_EQ(reflection_influence(probe, {10, 0.6 * 3.9, 0.8 * 3.9}), 1.0f);
    EXPECT_EQ(reflection_influence(probe, {10, 0.6 * 4.1, 0.8 * 4.1}), 0.0f);
    EXPECT_EQ(reflection_influence(probe, {0, 0, 0}), 0.0f);
}

TEST(BlendReflections, SmallBoxesCoverLargeOnesAndTheSky) {
    const std::vector probes{ReflectionProbe{}, box_probe({0, 0, 0}, {9, 9, 9}, 1.0f),
                             box_probe({0, 0, 0}, {2, 2, 2}, 1.0f)};
    EXPECT_EQ(weights_of(probes, {0, 0, 0}), (std::vector<double>{0, 0, 1}));
    EXPECT_EQ(weights_of(probes, {2, 0, 0}), (std::vector<double>{0, 0, 1}));  // at its wall
    EXPECT_EQ(weights_of(probes, {5, 0, 0}), (std::vector<double>{0, 1, 0}));
    EXPECT_EQ(weights_of(probes, {9, 9, 0}), (std::vector<double>{0, 1, 0}));
    EXPECT_EQ(weights_of(probes, {20, 0, 0}), (std::vector<double>{1, 0, 0}));
    const auto between = weights_of(probes, {2 * kReach + 0.5, 0, 0});
    EXPECT_NEAR(between[2], 0.5, 1e-6);
    EXPECT_NEAR(between[1], 0.5, 1e-6);
    EXPECT_NEAR(weights_of(probes, {9 * kReach + 0.5, 0, 0})[0], 0.5, 1e-6);
}

TEST(BlendReflections, RoomsShareADoorwayAsLongAsTheBlendDistanceWithoutTheSky) {
    const float wall = 0.25f;
    const std::vector probes{ReflectionProbe{}, box_probe({0, 0, 0}, {2, 2, 2}, wall),
                             box_probe({5 + wall, 0, 0}, {3, 2, 2}, wall)};
    // 0.001 × (2 + 3) m of the doorway are in the boxes, which are taken larger.
    const double begin = 2 * kReach, length = wall - 0.005;
    for (int i = 0; i <= 100; ++i) {
        const double place = i / 100.0;
        const auto weights = weights_of(probes, {begin + place * length, 0.5, 0});
        const double t = 1.0 - place * length / wall;
        EXPECT_EQ(weights[0], 0.0) << i;
        EXPECT_NEAR(weights[1], t * t * (3.0 - 2.0 * t), 1e-6) << i;
        EXPECT_NEAR(weights[1] + weights[2], 1.0, 1e-6) << i;
    }
    EXPECT_EQ(weights_of(probes, {begin + wall, 0, 0}), (std::vector<double>{0, 0, 1}));
}

TEST(BlendReflections, ImportantProbesCoverOthersOfAnySize) {
    std::vector probes{box_probe({0, 0, 0}, {2, 2, 2}, 0.0f, 1),
                       box_probe({0, 0, 0}, {9, 9, 9}, 0.0f, 2)};
    EXPECT_EQ(weights_of(probes, {0, 0, 0}), (std::vector<double>{0, 1}));
    ReflectionProbe sky;
    sky.importance = 3;
    probes.push_back(sky);
    EXPECT_EQ(weights_of(probes, {0, 0, 0}), (std::vector<double>{0, 0, 1}));
}

TEST(BlendReflections, OfEqualProbesTheFirstCovers) {
    const std::vector probes{box_probe({0, 0, 0}, {2, 2, 2}), box_probe({0, 0, 0}, {2, 2, 2})};
    EXPECT_EQ(weights_of(probes, {0, 0, 0}), (std::vector<double>{1, 0}));
}

TEST(ReflectionOrder, IsThatOfImportanceThenVolumeThenPlaceInTheFile) {
    std::vector probes{ReflectionProbe{}, box_probe({0, 0, 0}, {2, 2, 2}),
                       box_probe({0, 0, 0}, {9, 9, 9}, 0.0f, 2), box_probe({1, 0, 0}, {2, 2, 2}),
                       box_probe({0, 0, 0}, {1, 1, 1})};
    EXPECT_EQ(reflection_order(view_of(probes)), (std::vector<uint32_t>{2, 4, 1, 3, 0}));
    EXPECT_TRUE(reflection_order({}).empty());
}

TEST(BlendReflections, WithoutASkyBoxesShareTheRest) {
    const std::vector probes{box_probe({0, 0, 0}, {2, 2, 2}, 2.0f),
                             box_probe({6, 0, 0}, {2, 2, 2}, 1.0f)};
    // 1.25 m and 0.75 m from the boxes: t = 3/8 and 1/4.
    const auto weights = weights_of(probes, {2 * kReach + 1.25, 0, 0});
    const double far = 0.375 * 0.375 * (3 - 0.75);
    const double t = 1.0 - (2.0 - 1.25 - 4 * (kReach - 1.0)), near = t * t * (3.0 - 2.0 * t);
    EXPECT_NEAR(weights[0], far / (far + near), 1e-6);
    EXPECT_NEAR(weights[1], near / (far + near), 1e-6);
    EXPECT_EQ(weights_of(probes, {-2.9, 0, 0}), (std::vector<double>{1, 0}));
}

TEST(BlendReflections, OutsideAllBoxesTheNearestBoxLights) {
    const std::vector probes{box_probe({0, 0, 0}, {1, 1, 1}), box_probe({10, 0, 0}, {5, 1, 1})};
    EXPECT_EQ(weights_of(probes, {2, 0, 0}), (std::vector<double>{1, 0}));
    EXPECT_EQ(weights_of(probes, {4, 0, 0}), (std::vector<double>{0, 1}));  // its side is nearer
}

TEST(BlendReflections, WithoutProbesIsEmpty) {
    const ReflectionBlend blend = blend_reflections({}, {0, 0, 0});
    EXPECT_EQ(blend.weights, (std::array<float, kMost>{}));
    EXPECT_EQ(blend.probes, (std::array<uint32_t, kMost>{}));
}

/// The four largest weights of probes that take of the rest in order, by sorting all of them.
struct Oracle {
    std::vector<double> weights;  ///< reduced by the fourth largest, not yet divided by `sum`
    double sum = 0.0;

    Oracle(const std::vector<ReflectionProbe>& probes, const glm::dvec3& position) {
        std::vector<size_t> order(probes.size());
        std::iota(order.begin(), order.end(), size_t{0});
        const auto volume = [&](size_t i) {
            const glm::dvec3 half(probes[i].half_size);
            return half.x * half.y * half.z;
        };
        std::ranges::stable_sort(order, [&](size_t a, size_t b) {
            return std::tuple(-probes[a].importance, volume(a)) <
                   std::tuple(-probes[b].importance, volume(b));
        });
        weights.resize(probes.size());
        double rest = 1.0;
        for (const size_t i : order) {
            const double influence = reflection_influence(probes[i], position);
            weights[i] = std::min(rest, influence);
            rest -= weights[i];
        }
        std::vector<double> sorted = weights;
        sorted.resize(std::max<size_t>(sorted.size(), 4));
        std::ranges::sort(sorted, std::greater());
        for (double& weight : weights) {
            weight = std::max(0.0, weight - sorted[3]);
            sum += weight;
        }
    }
};

std::vector<ReflectionProbe> random_probes(std::mt19937& random, size_t count) {
    std::uniform_real_distribution<float> place(-3.0f, 3.0f), size(1.0f, 4.0f), blend(0.5f, 3.0f);
    std::vector<ReflectionProbe> probes;
    for (size_t i = 0; i < count; ++i) {
        const glm::mat3 axes = test::random_axes(random);
        ReflectionProbe& probe =
            probes.emplace_back(box_probe({place(random), place(random), place(random)},
                                          {size(random), size(random), size(random)}, blend(random),
                                          static_cast<int32_t>(random() % 3)));
        probe.axes = {axes[0], axes[1], axes[2]};
    }
    return probes;
}

TEST(BlendReflections, AreTheLargestOfAllProbesInOrder) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-4.0, 4.0);
    size_t compared = 0;
    for (int i = 0; i < 20'000; ++i) {
        const auto probes = random_probes(random, 1 + i % 9);
        const glm::dvec3 position(place(random), place(random), place(random));
        const Oracle oracle(probes, position);
        if (oracle.sum < 1e-3) continue;
        ++compared;
        const auto weights = weights_of(probes, position);
        for (size_t probe = 0; probe < probes.size(); ++probe) {
            ASSERT_NEAR(weights[probe], oracle.weights[probe] / oracle.sum, 1e-6 / oracle.sum);
        }
    }
    EXPECT_GT(compared, 10'000u);
}

TEST(BlendReflections, CountAlsoWhereHundredsOfBoxesOverlap) {
    // 300 boxes have influence t² (3 − 2t) = 0.0018 with t = 1 / 40; two below them have 0.5.
    const glm::dvec3 position(20, 0, 0);
    std::vector<ReflectionProbe> probes;
    for (int i = 0; i < 300; ++i) {
        const float size = 1.0f + 0.001f * static_cast<float>((i * 7) % 300);
        const double distance = 20.0 - kReach * double{size};
        probes.push_back(box_probe({0, 0, 0}, glm::vec3(size),
                                   static_cast<float>(distance / (1.0 - 1.0 / 40.0))));
    }
    for (int i = 0; i < 2; ++i) probes.push_back(box_probe({0, 0, 0}, glm::vec3(9), 22.0f));
    const Oracle oracle(probes, position);
    ASSERT_GT(oracle.weights[300], 0.4);  // the largest, below all others
    const auto weights = weights_of(probes, position);
    for (size_t i = 0; i < probes.size(); ++i) {
        EXPECT_NEAR(weights[i], oracle.weights[i] / oracle.sum, 1e-5);
    }
}

TEST(BlendReflections, WeightsAddUpToOne) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-9.0, 9.0);
    for (int i = 0; i < 10'000; ++i) {
        const auto probes = random_probes(random, 1 + i % 6);
        const auto weights = weights_of(probes, {place(random), place(random), place(random)});
        ASSERT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0, 1e-6);
    }
}

double largest_change(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0.0;
    for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

/// Follows the largest change along a line from `a` to `b` into ever smaller pieces: where the
/// weights have a step, it stays.
struct LineSearch {
    const std::vector<ReflectionProbe>& probes;
    glm::dvec3 a, b;

    void halve() {
        const glm::dvec3 middle = 0.5 * (a + b);
        const auto at_middle = weights_of(probes, middle);
        const double first = largest_change(weights_of(probes, a), at_middle);
        const double second = largest_change(at_middle, weights_of(probes, b));
        (first > second ? b : a) = middle;
    }

    /// How much the weights may change from `a` to `b`. With n boxes of blend distances ≥ B, an
    /// influence changes by at most L d over a distance d, L = 1.5 / B (the steepest slope of the
    /// smooth step). A weight is an influence, or 1 minus influences, so that it changes by at most
    /// n L d, the fourth largest weight by no more, their differences u by twice that, and the sum
    /// S of three differences by six times that. u / S changes by at most (|Δu| + |ΔS|) / S.
    [[nodiscard]] double limit(double smallest_sum) const {
        const double slope = 1.5 / 0.5, count = static_cast<double>(probes.size());
        const double rounding = 1e-6;
        return (8.0 * count * slope * glm::distance(a, b) + rounding) / smallest_sum;
    }

    [[nodiscard]] double sum() const {
        return std::min(Oracle(probes, a).sum, Oracle(probes, b).sum);
    }
};

void expect_no_steps(std::mt19937& random, const std::vector<ReflectionProbe>& probes) {
    std::uniform_real_distribution<double> place(-3.0, 3.0);
    constexpr int kSteps = 200, kHalvings = 22;
    const glm::dvec3 begin(place(random), place(random), place(random));
    const glm::dvec3 end(place(random), place(random), place(random));
    for (int i = 0; i < kSteps; ++i) {
        const glm::dvec3 step = (end - begin) / double{kSteps};
        LineSearch search{probes, begin + double(i) * step, begin + (i + 1.0) * step};
        for (int j = 0; j < kHalvings; ++j) search.halve();
        const double sum = search.sum();
        if (sum < 1e-3) continue;  // nearly outside all boxes, or four equal weights
        ASSERT_LT(largest_change(weights_of(probes, search.a), weights_of(probes, search.b)),
                  search.limit(sum));
    }
}

TEST(BlendReflections, IsContinuousInsideBoxes) {
    std::mt19937 random(3);
    for (int i = 0; i < 60; ++i) expect_no_steps(random, random_probes(random, 2 + i % 5));
}

TEST(BlendReflections, IsContinuousEverywhereWithASky) {
    std::mt19937 random(4);
    for (int i = 0; i < 60; ++i) {
        auto probes = random_probes(random, 1 + i % 5);
        probes.emplace_back().importance = -1;
        expect_no_steps(random, probes);
    }
}

}  // namespace
}  // namespace tetralight
