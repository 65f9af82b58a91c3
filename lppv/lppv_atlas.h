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

// The proxy volumes of many objects in one 3D texture. A refresh refills only the volumes whose
// light may have changed.
//
//     LppvAtlas atlas({.slab_size = {64, 64, 32}});
//     const auto id = atlas.add(grid, LppvQuality::Normal, LppvRefresh::Automatic);
//     ... each frame: atlas.move(*id, moved_grid); atlas.refresh(volume, {});
//     upload atlas.texture(), or the boxes of the volumes in LppvAtlasReport::refilled

namespace tetralight {

/// The condition under which a volume of an atlas is refilled.
enum class LppvRefresh : uint8_t {
    Automatic,   ///< if it moved or lies in a cell of a changed probe
    EveryFrame,  ///< with every call of `refresh`
    Manual,      ///< after `mark`; until then the grid stays where it was filled
};

struct LppvAtlasSettings {
    /// Texels of one slab. Each volume takes the resolution of its grid plus 2 along each axis.
    glm::uvec3 slab_size{64, 64, 32};
    LppvLayout layout = LppvLayout::FourSlabs;
    LppvTexelFormat format = LppvTexelFormat::Half;
};

/// The changes of the probe volume since the last refresh.
struct ProbeChange {
    /// Probes whose light or occlusion changed.
    std::span<const uint32_t> probes = {};
    /// True if positions, cells or the ambient light may have changed too.
    bool is_everything = false;
};

/// The probes that come from groups of a volume, sorted. Precondition: indices into
/// `group_names`.
[[nodiscard]] std::vector<uint32_t> probes_of_groups(const ProbeVolumeView& volume,
                                                     std::span<const uint32_t> groups);

/// A box of texels in one slab.
struct TexelBox {
    glm::uvec3 min{0};
    glm::uvec3 size{0};

    bool operator==(const TexelBox&) const = default;
};

struct LppvAtlasReport {
    /// Ids of the refilled volumes, sorted.
    std::vector<uint32_t> refilled;
    /// Number of grid points in them.
    uint64_t point_count = 0;
};

/// The shader constants of one volume in the atlas, in std140 layout.
struct LppvAtlasConstants {
    /// Maps to texture coordinates in the first slab.
    glm::mat4 texture_from_world{1.0f};
    /// The centers of the volume's outer texels, in texture coordinates.
    glm::vec4 low{0.0f};
    glm::vec4 high{0.0f};
    /// For four slabs: band 2 of the object, 0 in quality `Low`.
    glm::vec4 shb_r{0.0f}, shb_g{0.0f}, shb_b{0.0f}, shc{0.0f};

    bool operator==(const LppvAtlasConstants&) const = default;
};

static_assert(sizeof(LppvAtlasConstants) == 160 &&
              std::is_trivially_copyable_v<LppvAtlasConstants>);

/// Proxy volumes packed into one texture. The bytes of a volume depend only on its grid, its
/// quality, its validity, its receiver and the probe volume, so that a partial and a complete
/// refill give the same bytes on any number of threads. Outside the hull of the probes the light is
/// extrapolated.
class LppvAtlas {
  public:
    explicit LppvAtlas(const LppvAtlasSettings& settings);

    /// Allocates texels for a volume, which the next refresh fills, and returns its id. Ids of
    /// removed volumes are reused. `validity`, its threshold and `receiver` are those of
    /// `LppvFill`. Returns out_of_resources if the atlas is full, and invalid_argument if
    /// `validity` does not have one value per grid point.
    [[nodiscard]] Result<uint32_t> add(const LppvGrid& grid, LppvQuality quality,
                                       LppvRefresh refresh, std::span<const float> validity = {},
                                       const Receiver& receiver = {});

    // Precondition of the following functions: `id` is the id of a volume in the atlas.

    void remove(uint32_t id);
    /// Preconditions: the grid has the volume's resolution, and `validity` is empty or has one
    /// value per grid point.
    void move(uint32_t id, const LppvGrid& grid, std::span<const float> validity = {});
    /// The next refresh refills the volume in every mode.
    void mark(uint32_t id);

    /// Refills the volumes whose light may have changed, on the caller's threads (`interpolate`
    /// describes `parallel_for`).
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

    /// The texels of the volume in each slab, with its guard texels.
    [[nodiscard]] TexelBox texels(uint32_t id) const;

    /// The constants for the grid at the time of the last refill.
    [[nodiscard]] LppvAtlasConstants constants(uint32_t id) const;

    /// Number of volumes.
    [[nodiscard]] size_t size() const noexcept { return size_; }

  private:
    struct Volume {
        LppvGrid grid;         ///< of the object now
        LppvGrid filled_grid;  ///< of the object at the last refill
        LppvQuality quality = LppvQuality::Normal;
        LppvRefresh refresh = LppvRefresh::Automatic;
        Receiver receiver;
        bool is_used = false;
        bool is_due = false;
        std::vector<uint32_t> nearest_valid;  ///< per point; empty: the point itself
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
    std::vector<size_t> task_starts_;  ///< indices into the ids to refill
    size_t size_ = 0;
};

/// The light in an atlas at a world position, for `sample_sh9`, and its occlusion; the twins of
/// runtime/shaders/lppv.glsl.
[[nodiscard]] PackedSh sample_lppv_atlas(const LppvTexture& atlas,
                                         const LppvAtlasConstants& constants,
                                         glm::vec3 position) noexcept;
[[nodiscard]] glm::vec4 sample_lppv_atlas_occlusion(const LppvTexture& atlas,
                                                    const LppvAtlasConstants& constants,
                                                    glm::vec3 position) noexcept;

}  // namespace tetralight
