// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/reflection/cube_image.h>
#include <tetralight/bake/sampling/sobol.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Where a cube is baked.
struct CubePosition {
    glm::dvec3 position{0.0};    ///< world
    float near_distance = 0.0f;  ///< surfaces nearer than this are not seen, metres
};

/// A baked cube.
struct BakedCube {
    CubeImage image;
    std::vector<CubeImage> layers;  ///< the light of each layer, which is part of `image`
    /// Fraction of the samples whose first hit was no back face, in [0, 1].
    float validity = 1.0f;
    uint64_t ray_count = 0;
};

/// One sample of the light of a cube.
struct CubeSample {
    glm::vec3 radiance{0.0f};
    bool hit_back_face = false;
    uint32_t ray_count = 0;
};

/// Samples the light at a world position from a unit direction. `spread`: width of the texel,
/// radians. `layers`: receives the radiance of each layer; 0 before. Thread-safe.
using SampleCube =
    std::function<CubeSample(const glm::dvec3& position, glm::vec3 direction, float spread,
                             const Sampler& sampler, std::span<glm::vec3> layers)>;

/// Receives each cube when it is finished, with its index; false cancels the bake.
using CubeFinished = std::function<bool(size_t index, const BakedCube& cube)>;

/// The samples of a cube.
struct CubeSampling {
    uint32_t size = 128;              ///< texels along a side of a face, at least 1
    uint32_t samples_per_texel = 64;  ///< at least 1
    uint64_t seed = 0;
    uint32_t thread_count = 0;  ///< 0 = all
    uint32_t layer_count = 0;
};

/// Bakes cubes: each texel is the mean of samples that are spread over its solid angle. A pure
/// function of (positions, sampling, `sample`), the same bits for any number of threads and for
/// each position whatever the other positions are. Progress counts the rows of
/// all faces as probes.
///
/// Returns invalid_argument if a position is not finite or light is beyond the range of float, and
/// cancelled if a callback returns false.
[[nodiscard]] Result<std::vector<BakedCube>> bake_cubes(std::span<const CubePosition> positions,
                                                        const CubeSampling& sampling,
                                                        const SampleCube& sample,
                                                        const BakeCallback& callback = {},
                                                        const CubeFinished& finished = {});

/// The same by paths through a scene (`PathCubes`). `settings.sample_count` is the number of paths
/// per texel, `settings.plan` has the layers. Returns also the errors of `PathCubes::make`.
[[nodiscard]] Result<std::vector<BakedCube>> bake_cubes(const Scene& scene,
                                                        std::span<const CubePosition> positions,
                                                        uint32_t size, const BakeSettings& settings,
                                                        const BakeCallback& callback = {});

}  // namespace tetralight
