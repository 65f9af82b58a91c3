// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shader_query.h>

#include <bit>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <span>

#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/seed_grid.h>

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
#include <tetralight/runtime/shaders/query_walls.glsl>
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
          tetralight_seeds(volume.seeds),
          tetralight_walls(volume.walls) {}

    TetralightVolumeConstants tetralight_volume;
    std::span<const vec4> tetralight_positions;
    std::span<const vec4> tetralight_light;
    std::span<const uvec4> tetralight_cells;
    std::span<const vec4> tetralight_hull_rays;
    std::span<const uvec4> tetralight_seeds;
    std::span<const uvec4> tetralight_walls;
};

static_assert(Shader::tetralight_finer_grid == kFinerGrid);
static_assert(Shader::tetralight_seed_header_words == kSeedGridHeaderWords);
static_assert(Shader::tetralight_seed_levels == kSeedGridLevels);
static_assert(Shader::tetralight_seed_longest_side == kSeedGridLongestSide);
static_assert(Shader::tetralight_unknown_edge == float{kUnknownEdge});
static_assert(Shader::tetralight_edge_code_unit == kEdgeCodeUnit);
static_assert(Shader::tetralight_hidden_share == kHiddenShare);
static_assert(Shader::tetralight_visibility_ramp == kVisibilityRamp);
static_assert(Shader::tetralight_normal_offset == kNormalOffset);

}  // namespace

CellLocation locate(const ShaderVolume& volume, glm::vec3 position, uint32_t hint) noexcept {
    const Shader::TetralightCellLocation location =
        Shader(volume).tetralight_locate(position, hint);
    const bool is_ambient = location.cell == kNoIndex;
    return {location.cell, is_ambient ? 1.0f : 0.0f, location.weights};
}

uint32_t seed_cell(const ShaderVolume& volume, glm::vec3 local) noexcept {
    return Shader(volume).tetralight_seed_cell(local);
}

CellLocation visible_location(const ShaderVolume& volume, CellLocation location) noexcept {
    location.weights =
        Shader(volume).tetralight_visible_location({location.cell, location.weights}).weights;
    return location;
}

glm::vec3 push_off_surface(const ShaderVolume& volume, glm::vec3 position, glm::vec3 normal,
                           const CellLocation& location, float normal_offset) noexcept {
    return Shader(volume).tetralight_push_off_surface(
        position, normal, {location.cell, location.weights}, normal_offset);
}

PackedProbe interpolate(const ShaderVolume& volume, const CellLocation& location,
                        Walls walls) noexcept {
    Shader shader(volume);
    const Shader::TetralightCellLocation where{location.cell, location.weights};
    return std::bit_cast<PackedProbe>(walls == Walls::Ignore
                                          ? shader.tetralight_blend(where)
                                          : shader.tetralight_interpolate(where));
}

}  // namespace tetralight
