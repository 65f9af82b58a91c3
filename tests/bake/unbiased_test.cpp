// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <random>
#include <vector>

#include <tetralight/bake/lights/scene_openings.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include "tests/support/property.h"
#include "tests/support/random_probes.h"
#include "tests/support/random_scene.h"
#include "tests/support/simple_tracer.h"

// The mean light of the baker in random scenes, whatever it samples, is that of a tracer that
// samples nothing but the cosine.

namespace tetralight {
namespace {

constexpr size_t kProbesPerScene = 2;

/// Estimates whose spread gives the error of their mean.
constexpr uint32_t kTrials = 32, kReferenceTrials = 136;
constexpr uint32_t kSamples = 1024, kReferenceSamples = 1024;

/// Which openings are sampled.
enum class Drawn { None, Found, Wrong };

/// A way to sample light.
struct Way {
    const char* name;
    PathSettings settings;
    Drawn drawn = Drawn::None;
};

constexpr uint32_t kBounces = 4;

const std::vector<Way> kWays{{"both", {kBounces, 0.0f, LightStrategy::Mis}},
                             {"lights", {kBounces, 0.0f, LightStrategy::LightOnly}},
                             {"BSDF", {kBounces, 0.0f, LightStrategy::BsdfOnly}}};

/// Openings are sampled by paths of all lengths only. The others forget less than a millionth of
/// the light: no albedo is larger than 0.8.
constexpr uint32_t kManyBounces = 60;

const std::vector<Way> kOpeningWays{{"found openings", {}, Drawn::Found},
                                    {"wrong openings", {}, Drawn::Wrong}};

const std::vector<Way> kTexelWays{{"texels", {}, Drawn::Wrong}};

/// What is baked at the places of a scene.
enum class Baked { Probes, Texels };

/// The normal of the texel at a place; zero for probes.
glm::vec3 normal_at(Baked baked, uint64_t key) {
    std::mt19937_64 engine(key);
    return baked == Baked::Texels ? test::random_direction(engine) : glm::vec3(0.0f);
}

RadianceSh estimate(const PathTracer& tracer, glm::vec3 origin, glm::vec3 normal, uint64_t key) {
    if (normal == glm::vec3(0.0f)) {
        static const DirectionSet directions(kSamples);
        return estimate_probe(tracer, origin, key, directions).radiance;
    }
    const glm::vec3 offset(0.0f);
    return estimate_texel(tracer, origin, {normal, {&offset, 1}}, key, kSamples).radiance;
}

/// Four rectangles in all directions in and around a room.
std::vector<Opening> random_openings(uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    std::vector<Opening> openings(4);
    for (Opening& opening : openings) {
        const glm::vec3 normal = test::random_direction(engine);
        const glm::vec3 side = glm::normalize(glm::cross(normal, test::random_direction(engine)));
        opening = {2.5f * glm::vec3(uniform(engine), 0.6f * uniform(engine), uniform(engine)),
                   (1.0f + 0.5f * uniform(engine)) * side,
                   (1.0f + 0.5f * uniform(engine)) * glm::cross(normal, side), normal};
    }
    return openings;
}

/// Four rectangles that are walls, panes, screens and emitters of the scene.
std::vector<Opening> surfaces_as_openings(const Scene& scene, const TraceScene& traced,
                                          uint64_t seed) {
    std::vector<Opening> openings;
    for (const MeshInstance& instance : scene.instances) {
        const std::vector<glm::vec3>& positions = scene.meshes[instance.mesh].positions;
        if (positions.size() != 4) continue;
        const auto at = [&](size_t i) {
            return traced.render_from_world(world_position(instance, positions[i]));
        };
        const glm::vec3 along = at(1) - at(0), across = at(3) - at(0);
        const glm::vec3 normal = glm::normalize(glm::cross(along, across));
        // Towards the middle.
        const float sign = glm::dot(normal, at(0)) > 0.0f ? -1.0f : 1.0f;
        openings.push_back({at(0), along, across, sign * normal});
    }
    std::ranges::shuffle(openings, std::mt19937_64(seed));
    openings.resize(std::min<size_t>(openings.size(), 4));
    return openings;
}

std::vector<Opening> openings_for(Drawn drawn, const Scene& scene, const TraceScene& traced,
                                  uint64_t seed) {
    if (drawn == Drawn::None) return {};
    if (drawn == Drawn::Found) return openings_of(scene, traced);
    std::vector<Opening> openings = random_openings(seed);
    std::ranges::move(surfaces_as_openings(scene, traced, seed), std::back_inserter(openings));
    return openings;
}

constexpr size_t kValues = size_t{3} * kShCoefficientCount;

/// Means over independent trials, and the squares of their standard errors.
struct Means {
    std::array<double, kValues> mean{}, variance{};
};

template <class Estimate>
Means means_of(uint32_t trials, const Estimate& estimate) {
    std::array<double, kValues> sum{}, squares{};
    for (uint32_t trial = 0; trial < trials; ++trial) {
        const RadianceSh light = estimate(trial);
        for (size_t i = 0; i < kValues; ++i) {
            const double value = light.coefficients[i / 3][static_cast<int>(i % 3)];
            sum[i] += value;
            squares[i] += value * value;
        }
    }
    Means result;
    for (size_t i = 0; i < kValues; ++i) {
        result.mean[i] = sum[i] / trials;
        const double spread = squares[i] / trials - result.mean[i] * result.mean[i];
        result.variance[i] = std::max(0.0, spread) / (trials - 1);
    }
    return result;
}

/// A variable of Student's distribution as one of the normal distribution (Wallace 1959, "Bounds
/// on Normal Approximations to Student's and the Chi-Square Distributions").
double normal_from_student(double t, double freedom) {
    const double size = std::sqrt(freedom * std::log1p(t * t / freedom)) * (8.0 * freedom + 1.0) /
                        (8.0 * freedom + 3.0);
    return std::copysign(size, t);
}

/// Differences of the means in their standard errors. 0 where both are exactly the same.
std::array<double, kValues> differences(const Means& a, const Means& b) {
    std::array<double, kValues> z{};
    for (size_t i = 0; i < kValues; ++i) {
        const double difference = a.mean[i] - b.mean[i];
        // Float rounding of a mean.
        const double rounding = 1e-6 * std::abs(b.mean[0]);
        const double variance = a.variance[i] + b.variance[i] + rounding * rounding;
        if (difference == 0.0 || variance == 0.0) continue;
        // Degrees of freedom of a difference (Welch 1947).
        const double freedom = variance * variance /
                               (a.variance[i] * a.variance[i] / (kTrials - 1) +
                                b.variance[i] * b.variance[i] / (kReferenceTrials - 1) + 1e-300);
        z[i] = normal_from_student(difference / std::sqrt(variance), std::min(freedom, 1e6));
    }
    return z;
}

/// The differences of one way at one probe.
using Differences = std::array<double, kValues>;

/// The differences of all ways at all probes, by way and probe.
class Comparison {
  public:
    /// `reference_bounces`: of the simple tracer.
    Comparison(const std::vector<Way>& ways, Baked baked, uint32_t reference_bounces)
        : ways_(ways),
          baked_(baked),
          reference_bounces_(reference_bounces),
          differences_(ways.size()) {
        const size_t scenes = test::is_nightly() ? 300 : 30;
        for (auto& of_probes : differences_) of_probes.resize(scenes * kProbesPerScene);
        parallel_for(scenes, 0, [&](size_t scene) { compare(scene); });
    }

    [[nodiscard]] const std::vector<Differences>& of_way(size_t way) const {
        return differences_[way];
    }

  private:
    void compare(size_t scene_index) {
        const test::RandomScene random = test::make_random_scene(scene_index, kProbesPerScene);
        const auto traced = TraceScene::make_static(random.scene);
        ASSERT_TRUE(traced);
        const test::SimpleTracer simple(random.scene, *traced, reference_bounces_);
        std::vector<Means> references;
        for (const glm::dvec3& probe : random.probes) {
            const glm::vec3 normal = normal_at(baked_, probe_key(0, probe));
            references.push_back(means_of(kReferenceTrials, [&](uint32_t trial) {
                return simple.gather(traced->render_from_world(probe), probe_key(trial, probe),
                                     kReferenceSamples, normal);
            }));
        }
        for (size_t way = 0; way < ways_.size(); ++way) {
            const PathTracer tracer(
                random.scene, *traced, ways_[way].settings, {},
                openings_for(ways_[way].drawn, random.scene, *traced, scene_index));
            for (size_t i = 0; i < kProbesPerScene; ++i) {
                const glm::dvec3& probe = random.probes[i];
                const glm::vec3 normal = normal_at(baked_, probe_key(0, probe));
                const Means means = means_of(kTrials, [&](uint32_t trial) {
                    return estimate(tracer, traced->render_from_world(probe), normal,
                                    probe_key(1000 + trial, probe));
                });
                differences_[way][scene_index * kProbesPerScene + i] =
                    differences(means, references[i]);
            }
        }
    }

    const std::vector<Way>& ways_;
    Baked baked_;
    uint32_t reference_bounces_;
    std::vector<std::vector<Differences>> differences_;
};

/// The largest difference: all values of all ways pass with a probability of 1 − 1e-4 (Bonferroni).
void expect_no_outlier(const std::vector<Differences>& probes, size_t way_count) {
    const double comparisons = static_cast<double>(probes.size() * kValues * way_count);
    const double chance = 1e-4 / comparisons;
    for (size_t i = 0; i < probes.size(); ++i) {
        for (size_t k = 0; k < kValues; ++k) {
            const double z = std::abs(probes[i][k]);
            EXPECT_GT(std::erfc(z / std::sqrt(2.0)), chance)
                << "scene " << i / kProbesPerScene << ", probe " << i % kProbesPerScene
                << ", value " << k << ": " << probes[i][k];
        }
    }
}

/// The sums over the probes. The values of one probe depend on each other, those of different
/// probes do not: with P probes the mean of z² has a variance of at most 2/P, whatever the
/// dependence.
void expect_no_trend(const std::vector<Differences>& probes) {
    double squares = 0.0, lights = 0.0, count = 0.0;
    for (const Differences& z : probes) {
        for (const double value : z) squares += value * value;
        lights += z[1];  // green of band 0
        count += z[1] != 0.0;
    }
    EXPECT_NEAR(squares / (count * kValues), 1.0, 4.0 * std::sqrt(2.0 / count));
    EXPECT_LT(std::abs(lights) / std::sqrt(count), 4.5);
}

void expect_the_means_of_a_simple_tracer(const std::vector<Way>& ways, Baked baked,
                                         uint32_t bounces) {
    const Comparison comparison(ways, baked, bounces);
    for (size_t way = 0; way < ways.size(); ++way) {
        SCOPED_TRACE(ways[way].name);
        expect_no_outlier(comparison.of_way(way), ways.size());
        expect_no_trend(comparison.of_way(way));
    }
}

TEST(Unbiased, MeansInRandomScenesAreThoseOfASimpleTracer) {
    expect_the_means_of_a_simple_tracer(kWays, Baked::Probes, kBounces);
}

TEST(Unbiased, SamplesOfOpeningsDoNotChangeTheMeans) {
    expect_the_means_of_a_simple_tracer(kOpeningWays, Baked::Probes, kManyBounces);
}

TEST(Unbiased, MeansAtTexelsAreThoseOfASimpleTracer) {
    expect_the_means_of_a_simple_tracer(kTexelWays, Baked::Texels, kManyBounces);
}

}  // namespace
}  // namespace tetralight
