// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shader_volume.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <glm/common.hpp>

#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/seed_grid.h>

namespace tetralight {
namespace {

/// A double as the sum of two floats. `volatile` because GCC 12 removes the conversions of a pair
/// of doubles to float and back, so that the difference becomes 0.
struct TwoFloats {
    float whole = 0.0f;
    float rest = 0.0f;

    explicit TwoFloats(double value) {
        const volatile float rounded = static_cast<float>(value);
        whole = rounded;
        rest = static_cast<float>(value - static_cast<double>(rounded));
    }
};

/// For a volume without a seed grid: voxels over the bounding box of the probes, about one per
/// probe.
struct SeedVoxels {
    glm::vec3 min{0.0f};
    glm::vec3 voxel{0.0f};
    glm::uvec3 size{1};

    [[nodiscard]] size_t count() const { return size_t{size.x} * size.y * size.z; }

    [[nodiscard]] glm::vec3 center(size_t index) const {
        const glm::uvec3 place(index % size.x, index / size.x % size.y, index / size.x / size.y);
        return min + voxel * (glm::vec3(place) + 0.5f);
    }

    [[nodiscard]] SeedGridHeader header() const {
        SeedGridHeader header;
        for (int axis = 0; axis < 3; ++axis) {
            const auto place = static_cast<size_t>(axis);
            header.min[place] = min[axis];
            header.scale[place] = voxel[axis] > 0.0f ? 1.0f / voxel[axis] : 0.0f;
            header.size[place] = size[axis];
        }
        return header;
    }
};

SeedVoxels make_seed_voxels(std::span<const glm::vec3> positions) {
    SeedVoxels grid;
    grid.min = positions[0];
    glm::vec3 high = positions[0];
    for (const glm::vec3& position : positions) {
        grid.min = glm::min(grid.min, position);
        high = glm::max(high, position);
    }
    const glm::vec3 box = high - grid.min;
    const float longest = std::max({box.x, box.y, box.z});
    if (!(longest > 0.0f) || !(longest < std::numeric_limits<float>::max())) return grid;
    constexpr float kFinest = 4096.0f;
    for (float along = 1.0f; along <= kFinest && grid.count() < positions.size(); along *= 1.25f) {
        grid.size = glm::uvec3(glm::max(glm::ceil(box * (along / longest)), 1.0f));
    }
    grid.voxel = box / glm::vec3(grid.size);
    return grid;
}

/// A seed grid of one level.
std::vector<uint32_t> make_seed_words(const ProbeVolumeView& volume) {
    const SeedVoxels voxels = make_seed_voxels(volume.positions);
    std::vector<glm::vec3> centers(voxels.count());
    for (size_t i = 0; i < centers.size(); ++i) {
        centers[i] = glm::vec3(glm::dvec3(voxels.center(i)) + volume.info.world_origin);
    }
    std::vector<CellLocation> locations(centers.size());
    locate(volume, centers, locations);
    std::vector<uint32_t> words(kSeedGridHeaderWords);
    const SeedGridHeader header = voxels.header();
    std::memcpy(words.data(), &header, sizeof header);
    words.reserve(words.size() + locations.size());
    for (const CellLocation& location : locations) {
        words.push_back(location.cell < volume.cells.size() ? location.cell : 0);
    }
    return words;
}

/// Shaders begin their walks where the queries of the CPU do, if the volume has a seed grid.
bool has_seed_grid(const ProbeVolumeView& volume) {
    return volume.seed_grid.size() >= kSeedGridHeaderWords;
}

void add_seeds(const ProbeVolumeView& volume, ShaderVolume& shader) {
    std::vector<uint32_t> made;
    if (!has_seed_grid(volume)) made = make_seed_words(volume);
    const std::span<const uint32_t> words = made.empty() ? volume.seed_grid : std::span(made);
    shader.seeds.assign((words.size() + 3) / 4, glm::uvec4(0));
    std::memcpy(static_cast<void*>(shader.seeds.data()), words.data(), words.size_bytes());
    const SeedGridHeader header = seed_grid_header(words, 0);
    shader.constants.seed_min = {header.min[0], header.min[1], header.min[2], 0.0f};
    shader.constants.seed_scale = {header.scale[0], header.scale[1], header.scale[2], 0.0f};
    shader.constants.seed_size = {header.size[0], header.size[1], header.size[2],
                                  static_cast<uint32_t>(words.size())};
}

/// Blocks of cells that exist.
std::span<const VisibilityBlock> wall_blocks(const ProbeVolumeView& volume) {
    const size_t count = volume.cell_visibility.empty() ? 0 : (volume.cells.size() + 31) / 32;
    return volume.visibility_blocks.first(std::min(count, volume.visibility_blocks.size()));
}

/// Elements of `ShaderVolume::walls`.
size_t wall_element_count(const ProbeVolumeView& volume) {
    const size_t block_count = wall_blocks(volume).size();
    return block_count == 0 ? 1 : (block_count + 1) / 2 + volume.cell_visibility.size();
}

void add_walls(const ProbeVolumeView& volume, ShaderVolume& shader) {
    const std::span<const VisibilityBlock> blocks = wall_blocks(volume);
    shader.walls.reserve(wall_element_count(volume));
    shader.walls.resize(std::max<size_t>(1, (blocks.size() + 1) / 2), glm::uvec4(0));
    if (blocks.empty()) return;
    for (size_t i = 0; i < blocks.size(); ++i) {
        const int place = i % 2 == 0 ? 0 : 2;
        shader.walls[i / 2][place] = blocks[i].first;
        shader.walls[i / 2][place + 1] = blocks[i].cells;
    }
    shader.constants.walls = {static_cast<uint32_t>(blocks.size()),
                              static_cast<uint32_t>(shader.walls.size()),
                              static_cast<uint32_t>(volume.cell_visibility.size()), 0};
    for (const CellVisibility& cell : volume.cell_visibility) {
        const auto words = std::bit_cast<std::array<uint32_t, 3>>(cell.codes);
        shader.walls.emplace_back(words[0], words[1], words[2], split_bits(cell));
    }
}

bool has_cells(const ProbeVolumeView& volume) {
    return !volume.positions.empty() && !volume.cells.empty() &&
           volume.info.dimension <= Dimension::Space;
}

size_t inner_cell_count(const ProbeVolumeView& volume) {
    return std::min<size_t>(volume.info.inner_cell_count, volume.cells.size());
}

ShaderCell make_cell(const ProbeVolumeView& volume, const Cell& cell) {
    ShaderCell made;
    for (int i = 0; i < 4; ++i) {
        const auto place = static_cast<size_t>(i);
        if (cell.vertices[place] < volume.positions.size()) {
            made.vertices[i] = cell.vertices[place];
        }
        if (cell.neighbors[place] < volume.cells.size()) {
            made.neighbors[i] = cell.neighbors[place];
        }
    }
    return made;
}

void add_cells(const ProbeVolumeView& volume, ShaderVolume& shader) {
    shader.cells.reserve(volume.cells.size());
    for (const Cell& cell : volume.cells) shader.cells.push_back(make_cell(volume, cell));
    const size_t hull_count = volume.cells.size() - shader.constants.counts.z;
    shader.hull_rays.assign(std::max<size_t>(1, 3 * hull_count), glm::vec4(0.0f));
    for (size_t i = 0; i < std::min(hull_count, volume.hull_rays.size()); ++i) {
        for (size_t k = 0; k < 3; ++k) {
            shader.hull_rays[3 * i + k] = glm::vec4(volume.hull_rays[i].rays[k], 0.0f);
        }
    }
}

void add_probes(const ProbeVolumeView& volume, ShaderVolume& shader) {
    const size_t count = volume.positions.size();
    const bool is_compact = volume.compact.size() == count;
    const bool has_light = volume.irradiance.size() == count;
    const bool has_occlusion = volume.occlusion.size() == count;
    shader.positions.reserve(count);
    shader.light.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        shader.positions.emplace_back(volume.positions[i], 0.0f);
        PackedProbe probe{shader.constants.ambient, glm::vec4(1.0f)};
        if (is_compact) {
            probe.sh = pack_sh(compact_irradiance(volume.compact[i], volume.info.compact_scale));
            probe.occlusion = compact_occlusion(volume.compact[i]);
        } else {
            if (has_light) probe.sh = pack_sh(volume.irradiance[i]);
            if (has_occlusion) probe.occlusion = volume.occlusion[i];
        }
        shader.light.push_back(probe);
    }
}

size_t seed_memory(const ProbeVolumeView& volume) {
    if (has_seed_grid(volume)) return volume.seed_grid.size_bytes() + sizeof(glm::uvec4);
    const size_t voxels = make_seed_voxels(volume.positions).count();
    return sizeof(SeedGridHeader) + 2 * sizeof(glm::uvec4) +
           voxels * (2 * sizeof(uint32_t) + sizeof(glm::vec3) + sizeof(CellLocation));
}

}  // namespace

size_t shader_volume_memory(const ProbeVolumeView& volume) {
    if (!has_cells(volume)) return sizeof(ShaderVolume) + 256;
    const size_t probes = volume.positions.size(), cells = volume.cells.size();
    return sizeof(ShaderVolume) + probes * (sizeof(glm::vec4) + sizeof(PackedProbe)) +
           cells * sizeof(ShaderCell) +
           (3 * (cells - inner_cell_count(volume)) + 1) * sizeof(glm::vec4) + seed_memory(volume) +
           wall_element_count(volume) * sizeof(glm::uvec4);
}

ShaderVolume make_shader_volume(const ProbeVolumeView& volume) {
    ShaderVolume shader;
    const glm::dvec3& origin = volume.info.world_origin;
    const TwoFloats x(origin.x), y(origin.y), z(origin.z);
    shader.constants.origin = {x.whole, y.whole, z.whole, volume.info.extent};
    shader.constants.origin_rest = {x.rest, y.rest, z.rest, 0.0f};
    shader.constants.axis = glm::vec4(glm::vec3(volume.info.axis), 0.0f);
    shader.constants.ambient = pack_sh(volume.info.ambient);
    if (!has_cells(volume)) {
        shader.positions.resize(1);
        shader.light.resize(1, PackedProbe{shader.constants.ambient, glm::vec4(1.0f)});
        shader.cells.resize(1);
        shader.hull_rays.resize(1);
        shader.seeds.resize(1);
        shader.walls.resize(1);
        return shader;
    }
    const auto cell_count = static_cast<uint32_t>(volume.cells.size());
    shader.constants.counts = {volume.probe_count(), cell_count,
                               static_cast<uint32_t>(inner_cell_count(volume)),
                               static_cast<uint32_t>(volume.info.dimension)};
    add_probes(volume, shader);
    add_cells(volume, shader);
    add_seeds(volume, shader);
    add_walls(volume, shader);
    return shader;
}

}  // namespace tetralight
