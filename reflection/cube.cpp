// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/cube.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

/// What a face looks along, and where its columns and rows go: s and t of OpenGL 4.6, table 8.19.
struct FaceAxes {
    glm::ivec3 forward, right, down;
};

constexpr std::array<FaceAxes, kCubeFaceCount> kFaces{{
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
    {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
}};

/// The coordinate of a vector along an axis of a face.
template <class Vector>
auto along(const glm::ivec3& axis, const Vector& v) noexcept {
    using Number = typename Vector::value_type;
    return static_cast<Number>(axis.x) * v.x + static_cast<Number>(axis.y) * v.y +
           static_cast<Number>(axis.z) * v.z;
}

/// The face that has the largest coordinate of a vector; the first axis of equals.
template <class Vector>
uint32_t face_of(const Vector& v) noexcept {
    const auto x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
    if (x >= y && x >= z) return v.x < 0 ? 1 : 0;
    if (y >= z) return v.y < 0 ? 3 : 2;
    return v.z < 0 ? 5 : 4;
}

/// Not a number becomes 0.
float unit_coordinate(float coordinate, float largest) noexcept {
    const float value = 0.5f * (coordinate / largest + 1.0f);
    return value > 0.0f ? std::min(value, 1.0f) : 0.0f;
}

/// ∫∫ (u² + v² + 1)^-3/2 du dv.
double solid_angle_antiderivative(double u, double v) noexcept {
    return std::atan2(u * v, std::sqrt(u * u + v * v + 1.0));
}

}  // namespace

glm::vec3 cube_direction(const CubePlace& place) noexcept {
    TETRALIGHT_ASSERT(place.face < kCubeFaceCount, "no such face");
    const FaceAxes& axes = kFaces[place.face];
    const glm::vec2 st = 2.0f * place.uv - 1.0f;
    return glm::normalize(glm::vec3(axes.forward) + st.x * glm::vec3(axes.right) +
                          st.y * glm::vec3(axes.down));
}

glm::vec3 cube_direction(const CubeTexel& texel, uint32_t size) noexcept {
    const glm::vec2 center = glm::vec2(texel.x, texel.y) + 0.5f;
    return cube_direction(CubePlace{texel.face, center / static_cast<float>(size)});
}

CubePlace cube_place(glm::vec3 direction) noexcept {
    CubePlace place;
    place.face = face_of(direction);
    const FaceAxes& axes = kFaces[place.face];
    const float largest = along(axes.forward, direction);
    place.uv = {unit_coordinate(along(axes.right, direction), largest),
                unit_coordinate(along(axes.down, direction), largest)};
    return place;
}

double cube_solid_angle(uint32_t x, uint32_t y, uint32_t size) noexcept {
    const double scale = 2.0 / size;
    const double left = x * scale - 1.0, right = (x + 1.0) * scale - 1.0;
    const double top = y * scale - 1.0, bottom = (y + 1.0) * scale - 1.0;
    return solid_angle_antiderivative(right, bottom) - solid_angle_antiderivative(left, bottom) -
           solid_angle_antiderivative(right, top) + solid_angle_antiderivative(left, top);
}

CubeTexel wrapped_texel(uint32_t face, int x, int y, uint32_t size) noexcept {
    TETRALIGHT_ASSERT(face < kCubeFaceCount && size > 0, "no such face");
    // In halves of texels the cube reaches from -n to n, and centers lie at odd or even numbers
    // that differ from n in parity. A center half a texel beyond an edge lies as far below it on
    // the other face.
    const int n = static_cast<int>(size);
    int s = 2 * x + 1 - n, t = 2 * y + 1 - n, depth = n;
    if (std::abs(s) > n) {
        s = s < 0 ? -n : n;
        t = std::clamp(t, 1 - n, n - 1);
        depth = n - 1;
    } else if (std::abs(t) > n) {
        t = t < 0 ? -n : n;
        depth = n - 1;
    }
    const FaceAxes& from = kFaces[face];
    const glm::ivec3 center = depth * from.forward + s * from.right + t * from.down;
    CubeTexel texel;
    texel.face = face_of(center);
    const FaceAxes& to = kFaces[texel.face];
    texel.x = static_cast<uint32_t>((along(to.right, center) + n - 1) / 2);
    texel.y = static_cast<uint32_t>((along(to.down, center) + n - 1) / 2);
    return texel;
}

}  // namespace tetralight
