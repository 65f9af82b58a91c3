// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/reflection_pmrem.h>

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/reflection/prefilter_cube.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/base/half.h>
#include <tetralight/bench/harness.h>
#include <tetralight/pipeline/bake_reflections.h>
#include <tetralight/reflection/sample_reflections.h>

namespace tetralight::bench {
namespace {

constexpr uint32_t kDirections = 2000;
constexpr float kRoughnesses[] = {0.125f, 0.25f, 0.375f, 0.5f, 0.625f, 0.75f, 0.875f, 1.0f};

/// A part of a cube over which the lobe is taken as constant.
struct Patch {
    glm::dvec3 direction{0.0};  ///< unit
    glm::dvec3 light{0.0};
    double solid_angle = 0.0;
};

/// The texels, each cut into n × n.
std::vector<Patch> patches_of(const CubeImage& cube, uint32_t n) {
    std::vector<Patch> patches;
    const uint32_t size = n * cube.size;
    for (uint32_t face = 0; face < kCubeFaceCount; ++face) {
        for (uint32_t y = 0; y < size; ++y) {
            for (uint32_t x = 0; x < size; ++x) {
                const glm::vec3& light = cube.texels[cube.index({face, x / n, y / n})];
                patches.push_back({glm::dvec3(cube_direction(CubeTexel{face, x, y}, size)),
                                   glm::dvec3(light), cube_solid_angle(x, y, size)});
            }
        }
    }
    return patches;
}

/// The mean of the light around a direction by the lobe, in doubles: of fine patches near the
/// direction, where the lobe is narrow, and of coarse ones elsewhere.
class BruteForce {
  public:
    explicit BruteForce(const CubeImage& cube)
        : coarse_(patches_of(cube, 1)), fine_(patches_of(cube, kCuts)), size_(cube.size) {}

    [[nodiscard]] glm::dvec3 at(const glm::dvec3& direction, double roughness) const {
        Sum sum;
        for (size_t i = 0; i < coarse_.size(); ++i) {
            if (glm::dot(direction, coarse_[i].direction) < kNear) {
                sum.add(coarse_[i], direction, roughness);
                continue;
            }
            const size_t row = i / size_, column = i % size_;
            for (uint32_t k = 0; k < kCuts * kCuts; ++k) {
                const size_t fine_row = kCuts * row + k / kCuts;
                sum.add(fine_[fine_row * kCuts * size_ + kCuts * column + k % kCuts], direction,
                        roughness);
            }
        }
        return sum.light / sum.weight;
    }

  private:
    static constexpr uint32_t kCuts = 4;
    static constexpr double kNear = 0.95;  ///< cosine of 18°

    struct Sum {
        glm::dvec3 light{0.0};
        double weight = 0.0;

        void add(const Patch& patch, const glm::dvec3& direction, double roughness) {
            const double cosine = std::min(1.0, glm::dot(direction, patch.direction));
            const double factor = ggx_lobe(cosine, roughness) * patch.solid_angle;
            light += factor * patch.light;
            weight += factor;
        }
    };

    std::vector<Patch> coarse_, fine_;
    size_t size_;
};

/// What a shader gets from our levels.
std::vector<glm::dvec3> light_of_levels(const Reflections& reflections, float roughness) {
    std::vector<glm::dvec3> light;
    for (uint32_t i = 0; i < kDirections; ++i) {
        const glm::vec3 direction = spherical_fibonacci(i, kDirections);
        light.emplace_back(sample_cube(reflections.view(), 0, direction, roughness));
    }
    return light;
}

std::vector<glm::dvec3> exact_light(const BruteForce& sum, float roughness) {
    std::vector<glm::dvec3> light(kDirections);
    parallel_for(kDirections, 0, [&](size_t i) {
        const glm::dvec3 direction(spherical_fibonacci(static_cast<uint32_t>(i), kDirections));
        light[i] = sum.at(direction, double{roughness});
    });
    return light;
}

template <class Vector>
nlohmann::json to_json(const std::vector<Vector>& vectors) {
    auto json = nlohmann::json::array();
    for (const Vector& v : vectors) json.push_back({v.x, v.y, v.z});
    return json;
}

/// The cube as its file has it: in halves.
CubeImage in_halves(const Reflections& reflections) {
    CubeImage cube{reflections.size, {}};
    for (const RadianceTexel& texel : reflections.levels[0]) {
        cube.texels.emplace_back(float_from_half(texel[0]), float_from_half(texel[1]),
                                 float_from_half(texel[2]));
    }
    return cube;
}

}  // namespace

void write_pmrem_subject(const std::string& folder, const std::string& name,
                         const CubeImage& cube) {
    Reflections reflections;
    reflections.size = cube.size;
    reflections.probes.emplace_back();
    add_cube(reflections, cube, 0);

    std::vector<glm::vec3> directions;
    for (uint32_t i = 0; i < kDirections; ++i)
        directions.push_back(spherical_fibonacci(i, kDirections));
    nlohmann::json subject{{"size", cube.size}, {"directions", to_json(directions)}};
    const BruteForce sum(in_halves(reflections));
    for (const float roughness : kRoughnesses) {
        subject["lobes"].push_back({{"roughness", roughness},
                                    {"exact", to_json(exact_light(sum, roughness))},
                                    {"ours", to_json(light_of_levels(reflections, roughness))}});
    }

    const std::string path = folder + '/' + name;
    std::ofstream(path + ".json") << subject;
    std::ofstream halves(path + ".halves", std::ios::binary);
    const auto bytes = std::as_bytes(std::span(reflections.levels[0]));
    halves.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
    require(bool(halves), "written: " + path);
}

void write_pmrem_checks(const std::string& folder, uint32_t size) {
    CubeImage constant{size, std::vector<glm::vec3>(cube_texel_count(size), {1.0f, 0.5f, 0.25f})};
    CubeImage gradient = constant;
    for (size_t i = 0; i < gradient.texels.size(); ++i)
        gradient.texels[i] = 1.0f + 0.8f * cube_direction(gradient.texel(i), size);
    write_pmrem_subject(folder, "constant", constant);
    write_pmrem_subject(folder, "gradient", gradient);
}

}  // namespace tetralight::bench
