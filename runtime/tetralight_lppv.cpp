// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>

#include <tetralight/lppv/lppv_texture.h>
#include <tetralight/runtime/detail/c_arrays.h>
#include <tetralight/runtime/detail/c_volume.h>
#include <tetralight/runtime/tetralight.h>

namespace {

using namespace tetralight;
using detail::CallError;
using detail::check_memory;
using detail::check_pointer;
using detail::finish;
using detail::succeed;

static_assert(sizeof(LppvConstants) == sizeof(tetralight_lppv_constants));
static_assert(offsetof(LppvConstants, params) == offsetof(tetralight_lppv_constants, params));
static_assert(offsetof(LppvConstants, shc) == offsetof(tetralight_lppv_constants, shc));

CallError check_enumerators(const tetralight_lppv_box& box) {
    if (box.placement > TETRALIGHT_LPPV_CELL_CENTERS) {
        return {TETRALIGHT_BAD_VALUE, str_cat("placement is out of range: ", box.placement)};
    }
    if (box.quality > TETRALIGHT_LPPV_FULL) {
        return {TETRALIGHT_BAD_VALUE, str_cat("quality is out of range: ", box.quality)};
    }
    if (box.layout > TETRALIGHT_LPPV_SEVEN_SLABS) {
        return {TETRALIGHT_BAD_VALUE, str_cat("layout is out of range: ", box.layout)};
    }
    if (box.format > TETRALIGHT_LPPV_FLOAT) {
        return {TETRALIGHT_BAD_VALUE, str_cat("format is out of range: ", box.format)};
    }
    return {};
}

Result<LppvGrid> make_grid(const tetralight_lppv_box& box) {
    const glm::dmat4 world_from_box(glm::make_mat4(box.world_from_box));
    const LppvPart part{world_from_box, glm::dvec3(glm::make_vec3(box.low)),
                        glm::dvec3(glm::make_vec3(box.high))};
    LppvSettings settings;
    settings.resolution_mode = LppvResolution::Custom;
    settings.resolution = {box.resolution[0], box.resolution[1], box.resolution[2]};
    settings.placement = static_cast<LppvPlacement>(box.placement);
    auto grid = make_lppv_grid({world_from_box, std::span(&part, 1)}, settings);
    if (!grid) return grid;
    // Seven slabs: no light goes into these.
    const LppvConstants constants =
        make_lppv_constants(Lppv{*grid, {}, {}, {}, {}, 0}, LppvLayout::SevenSlabs);
    const auto* floats = reinterpret_cast<const float*>(&constants);
    const bool is_finite = std::all_of(floats, floats + sizeof constants / sizeof(float),
                                       [](float value) { return std::isfinite(value); });
    if (is_finite) return grid;
    return Error{
        ErrorCode::InvalidArgument,
        str_cat("the box is too large or too thin for shaders: low (", constants.low.x, ", ",
                constants.low.y, ", ", constants.low.z, "), 1 / size (", constants.size_inverse.x,
                ", ", constants.size_inverse.y, ", ", constants.size_inverse.z, "), 1 / scale ",
                constants.local_from_world[0][0], ", ", constants.local_from_world[1][1], ", ",
                constants.local_from_world[2][2])};
}

/// Bytes that a fill allocates at most: the grid's light, the cells of one task, and the texture.
size_t memory_of_fill(const LppvGrid& grid, size_t texture_bytes) {
    constexpr size_t kTaskPoints = 32768, kBytesAPoint = 128;
    return grid.point_count() * (sizeof(IrradianceSh) + sizeof(glm::vec4)) +
           std::min(grid.point_count(), kTaskPoints) * kBytesAPoint + texture_bytes;
}

LppvLayout layout_of(const tetralight_lppv_box& box) {
    return static_cast<LppvLayout>(box.layout);
}

size_t texture_size(const tetralight_lppv_box& box, const LppvGrid& grid) {
    return grid.point_count() * slab_count(layout_of(box)) *
           texel_size(static_cast<LppvTexelFormat>(box.format));
}

}  // namespace

tetralight_status tetralight_get_lppv_size(const tetralight_lppv_box* box,
                                           tetralight_lppv_size* size,
                                           tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("box", box)) return finish(wrong, error);
    if (auto wrong = check_pointer("size", size)) return finish(wrong, error);
    if (auto wrong = check_enumerators(*box)) return finish(wrong, error);
    const auto grid = make_grid(*box);
    if (!grid) return finish(grid.error(), error);
    *size = {
        {grid->resolution.x * slab_count(layout_of(*box)), grid->resolution.y, grid->resolution.z},
        texture_size(*box, *grid)};
    return succeed(error);
}

tetralight_status tetralight_fill_lppv(const tetralight_volume* volume,
                                       const tetralight_lppv_box* box,
                                       const tetralight_array* texels,
                                       tetralight_lppv_constants* constants,
                                       tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_pointer("box", box)) return finish(wrong, error);
    if (auto wrong = check_pointer("texels", texels)) return finish(wrong, error);
    if (auto wrong = check_pointer("constants", constants)) return finish(wrong, error);
    if (auto wrong = check_enumerators(*box)) return finish(wrong, error);
    const auto grid = make_grid(*box);
    if (!grid) return finish(grid.error(), error);
    const size_t bytes = texture_size(*box, *grid);
    if (auto wrong = detail::check_array("texels", *texels, 1, {bytes, 1}, detail::Gaps::Refused)) {
        return finish(wrong, error);
    }
    if (auto wrong = check_memory("a proxy volume", memory_of_fill(*grid, bytes))) {
        return finish(wrong, error);
    }
    LppvFill fill;
    fill.quality = static_cast<LppvQuality>(box->quality);
    const auto lppv = make_lppv(detail::view_of(*volume), *grid, fill);
    if (!lppv) return finish(lppv.error(), error);
    const LppvTexture texture =
        make_lppv_texture(*lppv, layout_of(*box), static_cast<LppvTexelFormat>(box->format));
    const LppvConstants made = make_lppv_constants(*lppv, layout_of(*box));
    std::memcpy(texels->data, texture.texels.data(), bytes);
    std::memcpy(constants, &made, sizeof made);
    return succeed(error);
}
