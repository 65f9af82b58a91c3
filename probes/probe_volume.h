// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <tetralight/probes/distant_light.h>
#include <tetralight/probes/hilbert.h>
#include <tetralight/probes/layer.h>
#include <tetralight/probes/light.h>
#include <tetralight/probes/mixed_lighting.h>
#include <tetralight/probes/no_index.h>
#include <tetralight/probes/sh.h>
#include <tetralight/probes/transfer.h>

// The probe volume: baked probes joined by one Delaunay tetrahedralization, whose tetrahedra and
// hull cells together fill space. ProbeVolume owns, ProbeVolumeView is what queries read: of a
// ProbeVolume in memory or of a mapped file (probes/probe_file.h).

namespace tetralight {

/// How far the probes of a volume spread, and with it what its cells are.
enum class Dimension : uint32_t {
    None = 0,  ///< no probes
    Point,     ///< one probe: one cell
    Line,      ///< probes on a line: segments between them; hull cells beyond the two ends
    Plane,     ///< probes in a plane: triangles; hull cells beyond the edges of their hull
    Space,     ///< tetrahedra; hull cells beyond the triangles of their hull
};

/// Vertices of an inner cell of a volume; a hull cell has one less.
[[nodiscard]] constexpr int cell_vertex_count(Dimension dimension) noexcept {
    return static_cast<int>(dimension);
}

/// A tetrahedron, or a hull cell: the space outside one triangle of the convex hull. In volumes of
/// lower dimension the same with fewer vertices, the unused places holding kNoIndex.
///
/// Inner cell: `neighbors[i]` is the cell across the face opposite `vertices[i]`; tetrahedra are
/// positively oriented, i.e. dot(v1 − v0, cross(v2 − v0, v3 − v0)) > 0, triangles
/// counter-clockwise around the volume's axis.
/// Hull cell: the triangle is counter-clockwise seen from outside; `neighbors[i]` is the hull cell
/// opposite `vertices[i]`, `neighbors[3]` the inner cell.
struct Cell {
    std::array<uint32_t, 4> vertices{kNoIndex, kNoIndex, kNoIndex, kNoIndex};
    std::array<uint32_t, 4> neighbors{kNoIndex, kNoIndex, kNoIndex, kNoIndex};

    bool operator==(const Cell&) const = default;
};

static_assert(sizeof(Cell) == 32 && std::is_trivially_copyable_v<Cell>);

/// The corners of the face opposite each corner of a positively oriented tetrahedron,
/// counter-clockwise seen from outside.
inline constexpr std::array<std::array<int, 3>, 4> kOutwardFaces{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Unit rays from the vertices of one hull cell, along which it is extruded to infinity. Unused
/// places are 0.
struct HullCellRays {
    std::array<glm::vec3, 3> rays{};

    bool operator==(const HullCellRays&) const = default;
};

static_assert(sizeof(HullCellRays) == 36 && std::is_trivially_copyable_v<HullCellRays>);

/// A cell where a walk can start: of the positions around one probe.
struct Seed {
    uint64_t hilbert_index = 0;  ///< of the probe in `VolumeInfo::seed_cube`
    uint32_t cell = 0;
    uint32_t reserved = 0;

    bool operator==(const Seed&) const = default;
};

static_assert(sizeof(Seed) == 16 && std::is_trivially_copyable_v<Seed>);

/// Where a probe came from. Several sources have one probe if they were welded. A source has none
/// if its probe was removed from the volume because it was inside geometry.
struct ProbeSource {
    uint32_t group = 0;  ///< index into `group_names`
    uint32_t index = 0;  ///< in the group
    uint32_t probe = 0;  ///< or kNoIndex

    bool operator==(const ProbeSource&) const = default;
};

static_assert(sizeof(ProbeSource) == 12 && std::is_trivially_copyable_v<ProbeSource>);

/// A probe as one cache line of half-precision floats: what the fast queries read.
struct alignas(64) CompactProbe {
    /// Irradiance coefficients / `VolumeInfo::compact_scale`: three channels of each in turn.
    std::array<uint16_t, 27> irradiance{};
    std::array<uint16_t, 4> occlusion{};
    uint16_t validity = 0;

    bool operator==(const CompactProbe&) const = default;
};

static_assert(sizeof(CompactProbe) == 64 && std::is_trivially_copyable_v<CompactProbe>);

/// What the corners of one cell see along its edges, as codes of edge ratios
/// (probes/edge_visibility.h). codes[4 k + i] is that of the edge from corner i to corner
/// (i + k + 1) % 4. Codes of places without a vertex are 0.
struct CellVisibility {
    std::array<uint8_t, 12> codes{};
    /// Bits that say which two blocked edges from a corner are blocked by different walls
    /// (`split_bit`).
    std::array<uint8_t, 2> splits{};

    bool operator==(const CellVisibility&) const = default;
};

static_assert(sizeof(CellVisibility) == 14 && std::is_trivially_copyable_v<CellVisibility>);

/// Which of 32 consecutive cells have an element of `cell_visibility`.
struct VisibilityBlock {
    uint32_t first = 0;  ///< index of the element of the first of them
    uint32_t cells = 0;  ///< bit i: cell 32 · block + i has one

    bool operator==(const VisibilityBlock&) const = default;
};

static_assert(sizeof(VisibilityBlock) == 8 && std::is_trivially_copyable_v<VisibilityBlock>);

/// Quality of the light of a baked probe.
struct ProbeHealth {
    /// Relative standard error of its irradiance: root mean square over all normals. 0: not known.
    float standard_error = 0.0f;
    /// Distance to the nearest surface, metres; infinite if there is no surface.
    float surface_distance = std::numeric_limits<float>::infinity();
    /// Virtual offset: from the probe to the position outside of geometry that its rays start from.
    glm::vec3 virtual_offset{0.0f};
    /// Not zero: the probe is invalid, and its light was interpolated from valid probes around it.
    uint32_t is_dilated = 0;

    bool operator==(const ProbeHealth&) const = default;
};

static_assert(sizeof(ProbeHealth) == 24 && std::is_trivially_copyable_v<ProbeHealth>);

/// The light of each channel of a probe's occlusion, by index; kNoIndex for none.
using OcclusionLights = std::array<uint32_t, 4>;

/// The fixed-size facts of a volume.
struct VolumeInfo {
    /// World position of the local origin. Arrays of float positions are relative to it, so that a
    /// volume far from the world's origin keeps its precision.
    glm::dvec3 world_origin{0.0};
    /// The curve that orders `seeds`, in local positions; 0 without seeds.
    HilbertCube seed_cube;
    /// Plane: its unit normal; line: its unit direction; otherwise 0. A cell holds all positions
    /// that lie beside it along the normal, or around it across the direction.
    glm::dvec3 axis{0.0};
    Dimension dimension = Dimension::None;
    /// Cells [0, inner_cell_count) are inner cells (tetrahedra), all others hull cells.
    uint32_t inner_cell_count = 0;
    /// Fraction of the radial direction in the hull rays (docs/conventions.md).
    float radial_fraction = 0.0f;
    /// Light of the environment alone, for positions without a probe.
    IrradianceSh ambient;
    /// Distance of the farthest probe from the local origin, metres.
    float extent = 0.0f;
    /// What coefficients of compact probes are multiplied by: a power of two. 0: there are none.
    float compact_scale = 0.0f;

    bool operator==(const VolumeInfo&) const = default;
};

static_assert(sizeof(VolumeInfo) == 208 && std::is_trivially_copyable_v<VolumeInfo>);

/// Read-only spans over a probe volume. Cheap to copy; valid as long as its owner.
struct ProbeVolumeView {
    VolumeInfo info;

    // One a probe.
    std::span<const glm::vec3> positions;      ///< relative to `info.world_origin`
    std::span<const IrradianceSh> irradiance;  ///< empty: not baked, every answer is ambient
    std::span<const glm::vec4> occlusion;      ///< empty: (1, 1, 1, 1); 1 = lit
    std::span<const float> validity;      ///< empty: 1; fraction of samples that hit no back face
    std::span<const ProbeHealth> health;  ///< empty: not known
    /// Irradiance, occlusion and validity in half precision (`make_compact_probes`). Queries read
    /// these instead of `irradiance` and `occlusion`; if empty, they read the floats.
    std::span<const CompactProbe> compact;
    std::span<const glm::dvec3> exact_positions;  ///< world positions that were tetrahedralized

    std::span<const Cell> cells;
    std::span<const HullCellRays> hull_rays;  ///< one a hull cell
    /// Sorted by Hilbert index; of older files. Read only if there is no seed grid.
    std::span<const Seed> seeds;
    /// Where walks without a hint begin (probes/seed_grid.h). Empty: at one of `seeds`.
    std::span<const uint32_t> seed_grid;

    // Walls between probes (probes/edge_visibility.h). Both empty: not known, no wall hides a
    // probe.
    std::span<const VisibilityBlock> visibility_blocks;  ///< one for each 32 cells
    std::span<const CellVisibility> cell_visibility;     ///< of cells with a blocked edge, in order

    /// One a probe, bit i: it lights objects on rendering layer i. Empty: all of them.
    std::span<const uint32_t> rendering_layers;

    std::span<const ProbeSource> sources;  ///< sorted by group, then index
    std::string_view group_names;          ///< sorted, each ended by '\n'
    std::span<const Light> lights;         ///< the lights of the bake; world space
    std::string_view light_names;          ///< each ended by '\n'
    std::string_view metadata;             ///< how the volume was made: a JSON object, or empty

    // Light that can change after the bake (probes/recombine.h, probes/relight.h). May be empty.
    std::span<const LightState> light_states;           ///< one a light
    std::span<const OcclusionLights> occlusion_lights;  ///< one a probe
    std::span<const Layer> layers;
    std::string_view layer_names;  ///< each ended by '\n'
    /// Layer after layer, one a probe each; `irradiance` is their weighted sum.
    std::span<const IrradianceSh> layer_irradiance;
    /// As `layer_irradiance`: the relative standard error of the irradiance of each layer, without
    /// the light that a limit of bounces cuts. 0: not known, or no light. Empty: not known.
    std::span<const float> layer_errors;
    std::span<const ProbeTransfer> transfer;  ///< one a probe: how layer "sky" follows the sky
    std::span<const DistantLight> sky;        ///< one: the sky that layer "sky" comes from
    /// One a probe, when it has a transfer: 0, or 1 + the `DeringWindow` that its layers took.
    std::span<const uint8_t> dering;

    [[nodiscard]] uint32_t probe_count() const noexcept {
        return static_cast<uint32_t>(positions.size());
    }

    /// The same volume for queries in full precision.
    [[nodiscard]] ProbeVolumeView without_compact() const noexcept {
        ProbeVolumeView full = *this;
        full.compact = {};
        return full;
    }
};

/// A probe volume in memory.
struct ProbeVolume {
    VolumeInfo info;
    std::vector<glm::vec3> positions;
    std::vector<IrradianceSh> irradiance;
    std::vector<glm::vec4> occlusion;
    std::vector<float> validity;
    std::vector<ProbeHealth> health;
    std::vector<CompactProbe> compact;
    std::vector<glm::dvec3> exact_positions;
    std::vector<Cell> cells;
    std::vector<HullCellRays> hull_rays;
    std::vector<Seed> seeds;
    std::vector<uint32_t> seed_grid;
    std::vector<VisibilityBlock> visibility_blocks;
    std::vector<CellVisibility> cell_visibility;
    std::vector<uint32_t> rendering_layers;
    std::vector<ProbeSource> sources;
    std::string group_names;
    std::vector<Light> lights;
    std::string light_names;
    std::string metadata;
    std::vector<LightState> light_states;
    std::vector<OcclusionLights> occlusion_lights;
    std::vector<Layer> layers;
    std::string layer_names;
    std::vector<IrradianceSh> layer_irradiance;
    std::vector<float> layer_errors;
    std::vector<ProbeTransfer> transfer;
    std::vector<DistantLight> sky;
    std::vector<uint8_t> dering;

    [[nodiscard]] ProbeVolumeView view() const noexcept;

    bool operator==(const ProbeVolume&) const = default;
};

/// A volume that owns what a view shows.
[[nodiscard]] ProbeVolume copy_volume(const ProbeVolumeView& view);

/// The lines of `group_names` or `light_names`.
[[nodiscard]] std::vector<std::string_view> split_names(std::string_view names);

}  // namespace tetralight
