// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/reflection/cube_image.h>

namespace tetralight {

RadianceSh project_cube(const CubeImage& cube) {
    RadianceShSum sum;
    for (size_t i = 0; i < cube.texels.size(); ++i) {
        const CubeTexel texel = cube.texel(i);
        RadianceShSum light;
        light.add(cube_direction(texel, cube.size), cube.texels[i]);
        const double solid_angle = cube_solid_angle(texel.x, texel.y, cube.size);
        for (glm::dvec3& coefficient : light.coefficients) coefficient *= solid_angle;
        sum += light;
    }
    return radiance_from_sum(sum, 1.0);
}

}  // namespace tetralight
