// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/reflection/bake_cubes.h>

#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/reflection/path_cubes.h>
#include <tetralight/bake/sampling/mix.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

bool is_finite(glm::dvec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Status check_positions(std::span<const CubePosition> positions) {
    for (size_t i = 0; i < positions.size(); ++i) {
        if (is_finite(positions[i].position)) continue;
        return Error{ErrorCode::InvalidArgument, "position", "",
                     str_cat("reflection probe ", i, ": position is not finite")};
    }
    return Ok{};
}

/// Bakes the rows of one cube.
class CubeBaker {
  public:
    CubeBaker(const CubePosition& position, const CubeSampling& sampling, const SampleCube& sample)
        : position_(position),
          sampling_(sampling),
          sample_(sample),
          key_(detail::mix(~probe_key(sampling.seed, position.position))) {
        cube_.image = {sampling.size, std::vector<glm::vec3>(cube_texel_count(sampling.size))};
        cube_.layers.resize(sampling.layer_count, cube_.image);
    }

    /// Returns the number of rays.
    uint64_t bake_row(size_t row) {
        TexelSum sum(sampling_.layer_count);
        for (uint32_t x = 0; x < sampling_.size; ++x) bake_texel(row * sampling_.size + x, sum);
        ray_count_ += sum.ray_count;
        back_face_count_ += sum.back_face_count;
        return sum.ray_count;
    }

    [[nodiscard]] BakedCube finish() {
        const double count =
            static_cast<double>(cube_.image.texels.size()) * sampling_.samples_per_texel;
        cube_.validity = static_cast<float>(1.0 - static_cast<double>(back_face_count_) / count);
        cube_.ray_count = ray_count_;
        return std::move(cube_);
    }

  private:
    /// Light of one texel, and rays of all of a row.
    struct TexelSum {
        explicit TexelSum(uint32_t layer_count) : layers(layer_count), sample(layer_count) {}

        glm::dvec3 radiance{0.0};
        std::vector<glm::dvec3> layers;
        std::vector<glm::vec3> sample;  ///< the layers of one sample
        uint64_t ray_count = 0;
        uint64_t back_face_count = 0;
    };

    void bake_texel(size_t index, TexelSum& sum) {
        const CubeTexel texel = cube_.image.texel(index);
        const auto size = static_cast<float>(sampling_.size);
        const double solid_angle = cube_solid_angle(texel.x, texel.y, sampling_.size);
        const auto spread = static_cast<float>(std::sqrt(solid_angle));
        const uint64_t key = detail::mix(key_ + (index + 1) * detail::kGoldenRatio64);
        sum.radiance = glm::dvec3(0.0);
        std::ranges::fill(sum.layers, glm::dvec3(0.0));
        for (uint32_t i = 0; i < sampling_.samples_per_texel; ++i) {
            Sampler sampler(key, i);
            const glm::vec2 place = glm::vec2(texel.x, texel.y) + sampler.next2();
            const glm::vec3 direction = cube_direction(CubePlace{texel.face, place / size});
            const glm::dvec3 start =
                position_.position + double{position_.near_distance} * glm::dvec3(direction);
            std::ranges::fill(sum.sample, glm::vec3(0.0f));
            const CubeSample found = sample_(start, direction, spread, sampler, sum.sample);
            sum.radiance += found.radiance;
            for (size_t k = 0; k < sum.layers.size(); ++k) sum.layers[k] += sum.sample[k];
            sum.ray_count += found.ray_count;
            sum.back_face_count += found.hit_back_face;
        }
        const double count = sampling_.samples_per_texel;
        cube_.image.texels[index] = glm::vec3(sum.radiance / count);
        for (size_t k = 0; k < sum.layers.size(); ++k)
            cube_.layers[k].texels[index] = glm::vec3(sum.layers[k] / count);
    }

    const CubePosition& position_;
    const CubeSampling& sampling_;
    const SampleCube& sample_;
    uint64_t key_;
    BakedCube cube_;
    std::atomic<uint64_t> ray_count_ = 0;
    std::atomic<uint64_t> back_face_count_ = 0;
};

Status check_light(const BakedCube& cube, size_t index) {
    for (const glm::vec3& texel : cube.image.texels) {
        if (is_finite(texel)) continue;
        return Error{ErrorCode::InvalidArgument, "radiance", "",
                     str_cat("reflection probe ", index, ": its light exceeds the range of float")};
    }
    return Ok{};
}

}  // namespace

Result<std::vector<BakedCube>> bake_cubes(std::span<const CubePosition> positions,
                                          const CubeSampling& sampling, const SampleCube& sample,
                                          const BakeCallback& callback,
                                          const CubeFinished& finished) {
    if (auto status = check_positions(positions); !status) return status.error();
    const size_t row_count = size_t{kCubeFaceCount} * sampling.size;
    const uint64_t samples = uint64_t{sampling.size} * sampling.samples_per_texel;
    ProgressReporter progress(callback, positions.size() * row_count);
    std::vector<BakedCube> cubes;
    for (size_t i = 0; i < positions.size(); ++i) {
        CubeBaker baker(positions[i], sampling, sample);
        parallel_for(row_count, sampling.thread_count, [&](size_t row) {
            if (progress.is_cancelled()) return;
            const uint64_t rays = baker.bake_row(row);
            progress.add_round({.samples = samples,
                                .expected_samples = samples,
                                .is_first = true,
                                .state = {.is_done = true}});
            progress.add_rays(rays);
        });
        if (progress.is_cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
        cubes.push_back(baker.finish());
        if (auto status = check_light(cubes.back(), i); !status) return status.error();
        if (finished && !finished(i, cubes.back())) return Error{ErrorCode::Cancelled, "cancelled"};
    }
    progress.finish();
    return cubes;
}

Result<std::vector<BakedCube>> bake_cubes(const Scene& scene,
                                          std::span<const CubePosition> positions, uint32_t size,
                                          const BakeSettings& settings,
                                          const BakeCallback& callback) {
    const auto paths = PathCubes::make(scene, settings);
    if (!paths) return paths.error();
    const SampleCube sample = [&](const glm::dvec3& position, glm::vec3 direction, float spread,
                                  const Sampler& sampler, std::span<glm::vec3> layers) {
        return paths->sample(position, direction, spread, sampler, layers);
    };
    const CubeSampling sampling{size, settings.sample_count, settings.seed, settings.thread_count,
                                settings.plan.layer_count};
    return bake_cubes(positions, sampling, sample, callback);
}

}  // namespace tetralight
