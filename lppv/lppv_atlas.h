// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/lppv/detail/box_packing.h>
#include <tetralight/lppv/detail/changed_probes.h>
#include <tetralight/lppv/lppv_texture.h>

// The proxy volumes of many objects in one 3D texture, refilled only where the light around them
// may have changed.
//
//     LppvAtlas atlas({.slab_size = {64, 64, 32}});
//     const auto id = atlas.add(grid, LppvQuality::Normal, LppvRefresh::Automatic);
//     ... each frame: atlas.move(*id, moved_grid); atlas.refresh(volume, {});
//     upload atlas.texture(), or the boxes of what the report says was refilled

namespace tetralight {

/// When a volume of an atlas is filled again.
enum class LppvRefresh : uint8_t {
    Automatic,   ///< when it moved, or lies among probes that changed
    EveryFrame,  ///< with every call of `refresh`
    Manual,      ///< after `mark`; what it shows stays behind the object until then
};

struct LppvAtlasSettings {
    /// Texels of one slab. Each volume takes its grid's resolution and two more along each axis.
    glm::uvec3 slab_size{64, 64, 32};
    LppvLayout layout = LppvLayout::FourSlabs;
    LppvTexelFormat format = LppvTexelFormat::Half;
};

/// What became different in the probe volume since the last refresh.
struct ProbeChange {
    /// Probes whose light or occlusion changed.
    std::span<const uint32_t> probes = {};
    /// Everything may have: other probes, other cells, other ambient light.
    bool is_everything = false;
};

/// The probes that groups of a volume were welded into, sorted. Precondition: indices into
/// `group_names`.
[[nodiscard]] std::vector<uint32_t> probes_of_groups(const ProbeVolumeView& volume,
                                                     std::span<const uint32_t> groups);

/// Texels of one slab.
struct TexelBox {
    glm::uvec3 low{0};
    glm::uvec3 size{0};

    bool operator==(const TexelBox&) const = default;
};

struct LppvAtlasReport {
    /// Ids of the volumes that were filled, sorted.
    std::vector<uint32_t> refilled;
    /// Grid points of those.
    uint64_t point_count = 0;
};

/// What a shader needs of one volume beside the atlas, as std140 has it.
struct LppvAtlasConstants {
    /// To texture coordinates in the first slab.
    glm::mat4 texture_from_world{1.0f};
    /// The middles of the volume's outer texels.
    glm::vec4 low{0.0f};
    glm::vec4 high{0.0f};
    /// For four slabs: band 2 of the whole object; 0 in quality `Low`.
    glm::vec4 shb_r{0.0f}, shb_g{0.0f}, shb_b{0.0f}, shc{0.0f};

    bool operator==(const LppvAtlasConstants&) const = default;
};

static_assert(sizeof(LppvAtlasConstants) == 160 &&
              std::is_trivially_copyable_v<LppvAtlasConstants>);

/// Proxy volumes packed into one texture. The bytes of a volume are a function of its grid, its
/// quality, its validity and the probe volume alone: refilling a part and refilling everything give
/// the same ones, on any number of threads. Outside the hull of the probes the light is
/// extrapolated.
class LppvAtlas {
  public:
    explicit LppvAtlas(const LppvAtlasSettings& settings);

    /// Finds room for a volume; the next refresh fills it. Ids of removed volumes are used again.
    /// Points whose `validity` is below that of `LppvFill` take the light of the nearest point
    /// whose is not; empty: all are free. Errors: there is no room (the message says for what),
    /// `validity` is not as long as the grid has points.
    [[nodiscard]] Result<uint32_t> add(const LppvGrid& grid, LppvQuality quality,
                                       LppvRefresh refresh, std::span<const float> validity = {});

    // Precondition of what follows: `id` is that of a volume which was added and not removed.

    void remove(uint32_t id);
    /// Preconditions: the grid has the resolution that the volume was added with, and as many
    /// points as `validity` has values, if it has any.
    void move(uint32_t id, const LppvGrid& grid, std::span<const float> validity = {});
    /// Has the next refresh fill the volume, whatever its mode.
    void mark(uint32_t id);

    /// Fills the volumes that need it, on the caller's threads (`interpolate` says what
    /// `parallel_for` is).
    template <class ParallelFor>
    LppvAtlasReport refresh(const ProbeVolumeView& volume, const ProbeChange& change,
                            ParallelFor&& parallel_for) {
        LppvAtlasReport report = begin_refresh(volume, change);
        parallel_for(task_starts_.size() - 1,
                     [&](size_t task) { run_task(volume, report.refilled, task); });
        return report;
    }

    LppvAtlasReport refresh(const ProbeVolumeView& volume, const ProbeChange& change);

    [[nodiscard]] const LppvTexture& texture() const noexcept { return texture_; }

    /// Where the volume lies in each slab, guard texels included.
    [[nodiscard]] TexelBox texels(uint32_t id) const;

    /// For the grid that the volume was last filled with.
    [[nodiscard]] LppvAtlasConstants constants(uint32_t id) const;

    /// Volumes that are there.
    [[nodiscard]] size_t size() const noexcept { return size_; }

  private:
    struct Volume {
        LppvGrid grid;         ///< where the object is
        LppvGrid filled_grid;  ///< where it was when it was filled
        LppvQuality quality = LppvQuality::Normal;
        LppvRefresh refresh = LppvRefresh::Automatic;
        bool is_there = false;
        bool is_due = false;
        std::vector<uint32_t> nearest_valid;  ///< of each point; empty: itself
        TexelBox texels;
        detail::LitBy lit_by;
        PackedSh band_2{};
    };

    struct Scratch;

    [[nodiscard]] LppvAtlasReport begin_refresh(const ProbeVolumeView& volume,
                                                const ProbeChange& change);
    void run_task(const ProbeVolumeView& volume, std::span<const uint32_t> ids, size_t task);
    [[nodiscard]] bool needs_refill(const Volume& volume,
                                    const detail::ChangedProbes& changed) const;
    void fill(const ProbeVolumeView& probes, Volume& volume, Scratch& scratch);
    void write(const Volume& volume, Scratch& scratch);

    LppvTexture texture_;
    detail::BoxPacking packing_;
    std::vector<Volume> volumes_;
    std::vector<uint32_t> free_ids_;
    std::vector<size_t> task_starts_;  ///< into the ids to fill
    size_t size_ = 0;
};

/// The light that a shader finds in an atlas at a world position, for `sample_sh9`; the twin of
/// runtime/shaders/lppv.glsl.
[[nodiscard]] PackedSh sample_lppv_atlas(const LppvTexture& atlas,
                                         const LppvAtlasConstants& constants,
                                         glm::vec3 position) noexcept;
[[nodiscard]] glm::vec4 sample_lppv_atlas_occlusion(const LppvTexture& atlas,
                                                    const LppvAtlasConstants& constants,
                                                    glm::vec3 position) noexcept;

}  // namespace tetralight
