// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/seed_grid_header.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace tetralight::detail {

SeedGridHeader make_seed_grid_header(const Box<glm::dvec3>& box, double voxel_count) {
    const glm::dvec3 size = box.max - box.min;
    const double longest = std::max({size.x, size.y, size.z});
    const auto sides = [&](double along) {
        return glm::max(glm::floor(size * (along / longest)), glm::dvec3(1.0));
    };
    const auto with_layer = [&](double inner, double length) {
        return length > 0.0 ? inner + 2.0 : 1.0;
    };
    SeedGridHeader header;
    header.min = {static_cast<float>(box.min.x), static_cast<float>(box.min.y),
                  static_cast<float>(box.min.z)};
    if (!(longest > 0.0) || !std::isfinite(longest)) return header;
    double coarsest = 1.0;
    double finest = kSeedGridLongestSide - 2;
    for (int i = 0; i < 48; ++i) {  // bisection of the voxels along the longest side
        const double middle = 0.5 * (coarsest + finest);
        const glm::dvec3 inner = sides(middle);
        const double count =
            with_layer(inner.x, size.x) * with_layer(inner.y, size.y) * with_layer(inner.z, size.z);
        (count > voxel_count ? finest : coarsest) = middle;
    }
    const glm::dvec3 inner = sides(coarsest);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<size_t>(axis);
        const auto scale = static_cast<float>(inner[axis] / size[axis]);
        if (!(size[axis] > 0.0) || !std::isfinite(scale)) continue;
        header.size[a] = static_cast<uint32_t>(inner[axis]) + 2;
        header.scale[a] = scale;
        header.min[a] = static_cast<float>(box.min[axis] - 1.0 / static_cast<double>(scale));
    }
    return header;
}

}  // namespace tetralight::detail
