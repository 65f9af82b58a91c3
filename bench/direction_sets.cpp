// SPDX-License-Identifier: Apache-2.0
// Projection error of direction sets for light with sharp edges, without path tracing.
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bench/harness.h>
#include <tetralight/probes/sh.h>

namespace tetralight::bench {
namespace {

constexpr uint32_t kDirections = 1024;
constexpr int kTrials = 400;

using Sky = std::function<float(glm::vec3)>;

float edge(glm::vec3 d) {
    return d.y > 0.0f ? 1.0f : 0.0f;
}

/// A window over 2 % of the sphere, 50 times as bright as the remaining sphere.
float window(glm::vec3 d) {
    return d.y > 0.96f ? 50.0f : 1.0f;
}

/// 8 × 16 fields of equal size.
float checker(glm::vec3 d) {
    const double turn = 0.5 + std::atan2(d.z, d.x) / (2.0 * std::numbers::pi);
    const int row = static_cast<int>(4.0 * (d.y + 1.0));
    return (row + static_cast<int>(16.0 * turn)) % 2 == 0 ? 1.0f : 0.0f;
}

RadianceSh project(const Sky& sky, const std::vector<glm::vec3>& directions,
                   const glm::mat3& turn) {
    RadianceShSum sum;
    for (const glm::vec3& d : directions) {
        const glm::vec3 turned = turn * d;
        sum.add(turned, glm::vec3(sky(turned)));
    }
    return radiance_from_sum(sum, 4.0 * std::numbers::pi / static_cast<double>(directions.size()));
}

/// Mean square error of irradiance over all normals, by Parseval's identity.
double square_error(const RadianceSh& a, const RadianceSh& b) {
    const IrradianceSh difference = irradiance_from_radiance(a + -1.0f * b);
    double sum = 0.0;
    for (const glm::vec3& c : difference.coefficients) sum += static_cast<double>(c.x) * c.x;
    return sum;
}

std::vector<glm::vec3> random_directions(RandomStream& random) {
    std::vector<glm::vec3> directions;
    for (uint32_t i = 0; i < kDirections; ++i) {
        directions.push_back(uniform_direction(random.next2()));
    }
    return directions;
}

void measure(const std::string& name, const Sky& sky) {
    const RadianceSh exact = project(sky, spherical_fibonacci(4'000'000), glm::mat3(1.0f));
    const std::vector<glm::vec3> one_set = spherical_fibonacci(kDirections);
    const std::vector<glm::vec3> eighth = spherical_fibonacci(kDirections / 8);
    double random_error = 0.0, one_error = 0.0, eight_error = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
        RandomStream random(1, static_cast<uint64_t>(trial));
        random_error +=
            square_error(project(sky, random_directions(random), glm::mat3(1.0f)), exact);
        one_error += square_error(project(sky, one_set, sample_rotation(random)), exact);
        RadianceSh eight;
        for (int set = 0; set < 8; ++set) eight += project(sky, eighth, sample_rotation(random));
        eight_error += square_error(0.125f * eight, exact);
    }
    report("bake.rmse." + name, std::sqrt(random_error / one_error), "times less than random");
    report("bake.rmse_8." + name, std::sqrt(random_error / eight_error), "times less than random");
}

}  // namespace

void bench_direction_sets() {
    measure("edge", edge);
    measure("window", window);
    measure("checker", checker);
}

}  // namespace tetralight::bench
