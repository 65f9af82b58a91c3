// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/lppv_atlas.h>

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/lppv/detail/apply_receiver.h>
#include <tetralight/lppv/detail/grid_positions.h>
#include <tetralight/lppv/detail/nearest_valid.h>
#include <tetralight/lppv/detail/slab_texels.h>
#include <tetralight/lppv/detail/write_guarded.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight {
namespace {

/// Width of the copies of the outer texels around each volume.
constexpr uint32_t kGuard = 1;

/// Grid points of one parallel task.
constexpr size_t kTaskPoints = 4096;

/// The mean of band 2 over a volume, without the other bands.
PackedSh mean_band_2(std::span<const PackedSh> light) {
    constexpr glm::vec4 PackedSh::*kVectors[] = {&PackedSh::shb_r, &PackedSh::shb_g,
                                                 &PackedSh::shb_b, &PackedSh::shc};
    PackedSh mean{};
    for (const auto vector : kVectors) {
        glm::dvec4 sum(0.0);
        for (const PackedSh& sh : light) sum += glm::dvec4(sh.*vector);
        mean.*vector = glm::vec4(sum / static_cast<double>(light.size()));
    }
    return mean;
}

/// Gives each point the light that seven slabs store.
void apply(LppvQuality quality, const PackedSh& band_2, std::span<PackedSh> light) {
    if (quality == LppvQuality::Full) return;
    for (PackedSh& sh : light) {
        sh = detail::with_band_2(detail::without_band_2(sh), band_2);
    }
}

std::vector<uint32_t> nearest_valid_points(const LppvGrid& grid, std::span<const float> validity) {
    if (validity.empty()) return {};
    return detail::nearest_valid(grid.resolution, grid.spacing(), validity,
                                 LppvFill{}.min_validity);
}

LppvTexture make_texture(const LppvAtlasSettings& settings) {
    LppvTexture texture{settings.layout, settings.format, settings.slab_size, {}};
    texture.size.x *= slab_count(settings.layout);
    texture.texels.resize(size_t{texture.size.x} * texture.size.y * texture.size.z *
                          texel_size(settings.format));
    return texture;
}

}  // namespace

std::vector<uint32_t> probes_of_groups(const ProbeVolumeView& volume,
                                       std::span<const uint32_t> groups) {
    std::vector<uint32_t> probes;
    for (const ProbeSource& source : volume.sources) {
        const bool is_member = std::ranges::find(groups, source.group) != groups.end();
        if (is_member && source.probe < volume.probe_count()) probes.push_back(source.probe);
    }
    std::ranges::sort(probes);
    probes.erase(std::unique(probes.begin(), probes.end()), probes.end());
    return probes;
}

LppvAtlas::LppvAtlas(const LppvAtlasSettings& settings)
    : texture_(make_texture(settings)), packing_(settings.slab_size), task_starts_{0} {}

Result<uint32_t> LppvAtlas::add(const LppvGrid& grid, LppvQuality quality, LppvRefresh refresh,
                                std::span<const float> validity, const Receiver& receiver) {
    if (auto status = detail::check_fill(grid, {.validity = validity}); !status) {
        return status.error();
    }
    const glm::uvec3 size = grid.resolution + 2 * kGuard;
    const auto min = packing_.allocate(size);
    if (!min) {
        return Error{
            ErrorCode::OutOfResources,
            str_cat("the atlas has no room for ", size.x, " x ", size.y, " x ", size.z, " texels; ",
                    packing_.used(), " of ", packing_.capacity(), " are in use")};
    }
    uint32_t id = static_cast<uint32_t>(volumes_.size());
    if (free_ids_.empty()) {
        volumes_.emplace_back();
    } else {
        id = free_ids_.back();
        free_ids_.pop_back();
    }
    Volume& volume = volumes_[id];
    volume = {};
    volume.grid = volume.filled_grid = grid;
    volume.quality = quality;
    volume.refresh = refresh;
    volume.receiver = receiver;
    volume.is_used = volume.is_due = true;
    volume.nearest_valid = nearest_valid_points(grid, validity);
    volume.texels = {*min, size};
    ++size_;
    return id;
}

void LppvAtlas::remove(uint32_t id) {
    TETRALIGHT_ASSERT(id < volumes_.size() && volumes_[id].is_used,
                      "id is the id of a volume in the atlas");
    packing_.release(volumes_[id].texels.min, volumes_[id].texels.size);
    volumes_[id] = {};
    free_ids_.push_back(id);
    --size_;
}

void LppvAtlas::move(uint32_t id, const LppvGrid& grid, std::span<const float> validity) {
    TETRALIGHT_ASSERT(id < volumes_.size() && volumes_[id].is_used,
                      "id is the id of a volume in the atlas");
    Volume& volume = volumes_[id];
    TETRALIGHT_ASSERT(grid.resolution == volume.grid.resolution,
                      "the grid has the resolution of the volume");
    TETRALIGHT_ASSERT(detail::check_fill(grid, {.validity = validity}),
                      "validity is empty or has one value per grid point");
    std::vector<uint32_t> nearest = nearest_valid_points(grid, validity);
    if (grid == volume.grid && nearest == volume.nearest_valid) return;
    volume.grid = grid;
    volume.nearest_valid = std::move(nearest);
    if (volume.refresh == LppvRefresh::Automatic) volume.is_due = true;
}

void LppvAtlas::mark(uint32_t id) {
    TETRALIGHT_ASSERT(id < volumes_.size() && volumes_[id].is_used,
                      "id is the id of a volume in the atlas");
    volumes_[id].is_due = true;
}

bool LppvAtlas::needs_refill(const Volume& volume, const detail::ChangedProbes& changed) const {
    if (!volume.is_used) return false;
    if (volume.is_due || volume.refresh == LppvRefresh::EveryFrame) return true;
    if (volume.refresh == LppvRefresh::Manual) return false;
    return changed.light(volume.lit_by);
}

LppvAtlasReport LppvAtlas::begin_refresh(const ProbeVolumeView& volume, const ProbeChange& change) {
    const detail::ChangedProbes changed(volume, change.probes, change.is_everything);
    LppvAtlasReport report;
    task_starts_.assign(1, 0);
    size_t points_of_task = 0;
    for (uint32_t id = 0; id < volumes_.size(); ++id) {
        if (!needs_refill(volumes_[id], changed)) continue;
        const size_t points = volumes_[id].grid.point_count();
        report.refilled.push_back(id);
        report.point_count += points;
        points_of_task += points;
        if (points_of_task < kTaskPoints) continue;
        task_starts_.push_back(report.refilled.size());
        points_of_task = 0;
    }
    if (task_starts_.back() < report.refilled.size()) {
        task_starts_.push_back(report.refilled.size());
    }
    return report;
}

/// The memory of one task.
struct LppvAtlas::Scratch {
    std::vector<glm::vec3> positions;
    std::vector<CellLocation> locations;
    std::vector<PackedSh> light;
    std::vector<glm::vec4> occlusion;
    std::vector<std::byte> texels;

    void resize(size_t count) {
        positions.resize(count);
        locations.resize(count);
        light.resize(count);
        occlusion.resize(count);
    }
};

void LppvAtlas::run_task(const ProbeVolumeView& volume, std::span<const uint32_t> ids,
                         size_t task) {
    Scratch scratch;
    for (size_t i = task_starts_[task]; i < task_starts_[task + 1]; ++i) {
        fill(volume, volumes_[ids[i]], scratch);
    }
}

/// Each volume is one batch, so that its light does not depend on the other volumes.
void LppvAtlas::fill(const ProbeVolumeView& probes, Volume& volume, Scratch& scratch) {
    scratch.resize(volume.grid.point_count());
    const detail::GridPositions position_of(volume.grid);
    for (size_t i = 0; i < scratch.positions.size(); ++i) {
        scratch.positions[i] = position_of(volume.grid.point(i));
    }
    locate(probes, scratch.positions, scratch.locations);
    const Walls walls = detail::apply_receiver(probes, scratch.locations, volume.receiver);
    const auto status = blend(probes, scratch.locations, scratch.light, scratch.occlusion, walls);
    TETRALIGHT_ASSERT(status, "the output has one element per location");
    detail::replace_invalid(volume.nearest_valid, std::span(scratch.light), scratch.occlusion);
    volume.band_2 = {};
    if (volume.quality != LppvQuality::Low) volume.band_2 = mean_band_2(scratch.light);
    if (texture_.layout == LppvLayout::SevenSlabs) {
        apply(volume.quality, volume.band_2, scratch.light);
    }
    write(volume, scratch);
    volume.filled_grid = volume.grid;
    volume.is_due = false;
    volume.lit_by.assign(probes, scratch.locations);
}

void LppvAtlas::write(const Volume& volume, Scratch& scratch) {
    const size_t bytes = texel_size(texture_.format);
    const size_t slabs = slab_count(texture_.layout);
    const size_t count = scratch.light.size();
    scratch.texels.resize(count * slabs * bytes);
    for (size_t i = 0; i < count; ++i) {
        const auto texels =
            detail::slab_texels(texture_.layout, scratch.light[i], scratch.occlusion[i]);
        for (size_t slab = 0; slab < slabs; ++slab) {
            detail::write_texel(&scratch.texels[(slab * count + i) * bytes], texture_.format,
                                texels[slab]);
        }
    }
    detail::write_guarded(texture_, volume.texels.min + kGuard, volume.grid.resolution,
                          scratch.texels);
}

LppvAtlasReport LppvAtlas::refresh(const ProbeVolumeView& volume, const ProbeChange& change) {
    return refresh(volume, change, [](size_t count, auto&& task) {
        for (size_t i = 0; i < count; ++i) task(i);
    });
}

TexelBox LppvAtlas::texels(uint32_t id) const {
    TETRALIGHT_ASSERT(id < volumes_.size() && volumes_[id].is_used,
                      "id is the id of a volume in the atlas");
    return volumes_[id].texels;
}

LppvAtlasConstants LppvAtlas::constants(uint32_t id) const {
    TETRALIGHT_ASSERT(id < volumes_.size() && volumes_[id].is_used,
                      "id is the id of a volume in the atlas");
    const Volume& volume = volumes_[id];
    const LppvGrid& grid = volume.filled_grid;
    LppvAtlasConstants constants;
    glm::dmat4 texture_from_local(0.0);
    texture_from_local[3].w = 1.0;
    for (int i = 0; i < 3; ++i) {
        const double size = texture_.size[i];
        const double center = volume.texels.min[i] + kGuard + 0.5;
        const double scale = grid.step[i] > 0.0 ? 1.0 / (grid.step[i] * size) : 0.0;
        texture_from_local[i][i] = scale;
        texture_from_local[3][i] = center / size - grid.first[i] * scale;
        constants.low[i] = static_cast<float>(center / size);
        constants.high[i] = static_cast<float>((center + grid.resolution[i] - 1.0) / size);
    }
    constants.texture_from_world = glm::mat4(texture_from_local * grid.local_from_world);
    constants.shb_r = volume.band_2.shb_r;
    constants.shb_g = volume.band_2.shb_g;
    constants.shb_b = volume.band_2.shb_b;
    constants.shc = volume.band_2.shc;
    return constants;
}

namespace {

glm::vec3 atlas_coordinates(const LppvAtlasConstants& constants, const glm::vec3& position) {
    return glm::clamp(glm::vec3(constants.texture_from_world * glm::vec4(position, 1.0f)),
                      glm::vec3(constants.low), glm::vec3(constants.high));
}

}  // namespace

PackedSh sample_lppv_atlas(const LppvTexture& atlas, const LppvAtlasConstants& constants,
                           glm::vec3 position) noexcept {
    PackedSh band_2{};
    band_2.shb_r = constants.shb_r;
    band_2.shb_g = constants.shb_g;
    band_2.shb_b = constants.shb_b;
    band_2.shc = constants.shc;
    return detail::sample_slabs(atlas, atlas_coordinates(constants, position), band_2);
}

glm::vec4 sample_lppv_atlas_occlusion(const LppvTexture& atlas, const LppvAtlasConstants& constants,
                                      glm::vec3 position) noexcept {
    if (atlas.layout == LppvLayout::SevenSlabs) return glm::vec4(1.0f);
    return filter_texture(atlas,
                          atlas_coordinates(constants, position) + glm::vec3(0.75f, 0.0f, 0.0f));
}

}  // namespace tetralight
