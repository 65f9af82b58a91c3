// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shader_query.h>

#include <bit>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <span>

namespace tetralight {
namespace {

using namespace glm;  // the types and functions of the shader language

/// An array of the shader as vectors.
template <class Vector, class Element>
std::span<const Vector> vectors_of(const std::vector<Element>& elements) {
    return {reinterpret_cast<const Vector*>(elements.data()),
            elements.size() * sizeof(Element) / sizeof(Vector)};
}

/// The text of the shader as members of a struct; the other members are the data that it reads.
struct Shader {
// The files in the order of a composed shader.
// clang-format off
#define TETRALIGHT_CPP
#include <tetralight/runtime/shaders/begin.glsl>
#include <tetralight/runtime/shaders/sh.glsl>
#include <tetralight/runtime/shaders/query_volume.glsl>
#include <tetralight/runtime/shaders/query_hull.glsl>
#include <tetralight/runtime/shaders/query.glsl>
#include <tetralight/runtime/shaders/end.glsl>

    // clang-format on

    explicit Shader(const ShaderVolume& volume) noexcept
        : tetralight_volume(std::bit_cast<TetralightVolumeConstants>(volume.constants)),
          tetralight_positions(volume.positions),
          tetralight_light(vectors_of<vec4>(volume.light)),
          tetralight_cells(vectors_of<uvec4>(volume.cells)),
          tetralight_hull_rays(volume.hull_rays),
          tetralight_seeds(volume.seeds) {}

    TetralightVolumeConstants tetralight_volume;
    std::span<const vec4> tetralight_positions;
    std::span<const vec4> tetralight_light;
    std::span<const uvec4> tetralight_cells;
    std::span<const vec4> tetralight_hull_rays;
    std::span<const uvec4> tetralight_seeds;
};

}  // namespace

CellLocation locate(const ShaderVolume& volume, glm::vec3 position, uint32_t hint) noexcept {
    const Shader::TetralightCellLocation location =
        Shader(volume).tetralight_locate(position, hint);
    const bool is_ambient = location.cell == kNoIndex;
    return {location.cell, is_ambient ? 1.0f : 0.0f, location.weights};
}

PackedProbe interpolate(const ShaderVolume& volume, const CellLocation& location) noexcept {
    return std::bit_cast<PackedProbe>(
        Shader(volume).tetralight_interpolate({location.cell, location.weights}));
}

}  // namespace tetralight
